#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"
#include "doctor/refusals.hpp"
#include "io/printable.hpp"
#include "laneloom/dds/topics.hpp"
#include "laneloom/state_names.hpp"
#include "mapping/trails/vehicles.hpp"
#include "status/report.hpp"

namespace laneloom::doctor {
namespace {

struct Incident {
  std::string_view counter, what, remedy;
};

constexpr std::string_view kNetwork =
    "See whether the network loses packets, and whether net.core.rmem_max of the kernel allows 4 MB.";
constexpr std::string_view kLoad =
    "See whether the host is overloaded, or give the service a real-time priority.";

constexpr std::array kIncidents{
    Incident{"detections_lost", "detections were lost on the way", kNetwork},
    Incident{"poses_lost", "poses were lost on the way", kNetwork},
    Incident{"objects_lost", "messages of objects were lost on the way", kNetwork},
    Incident{"next_turns_lost", "messages of the next turn were lost on the way", kNetwork},
    Incident{"frames_dropped_queue_full", "frames were dropped from a full queue (sync.queue_capacity)",
             kLoad},
    Incident{"poses_dropped_queue_full", "poses were dropped from a full queue (sync.pose_queue_capacity)",
             kLoad},
    Incident{"objects_dropped_queue_full",
             "messages of objects were dropped from a full queue (sync.queue_capacity)", kLoad},
    Incident{"next_turns_dropped_queue_full",
             "messages of the next turn were dropped from a full queue (sync.queue_capacity)", kLoad},
    Incident{"frames_thinned",
             "frames had more markings than gate.max_frame_detections and max_frame_length_m admit",
             "Send what the network trusts, within its range; the least trusted and farthest were left out."},
    Incident{"ticks_out_of_time", "ticks had no time left for all of their frames", kLoad},
    Incident{"elements_left_out", "elements of maps exceed the bounds of the IDL",
             "See the log of the service."},
    Incident{"writes_failed", "DDS did not take what the service wrote", "See the log of the service."},
    Incident{"snapshots_failed", "the snapshot could not be written",
             "See the log of the service, and the rights and space of the folder of service.snapshot_file."}};

/// Counters that only rise as a consequence of other findings.
constexpr std::array kConsequences{std::string_view("detections_refused_unsynchronised"),
                                   std::string_view("detections_refused_reset"),
                                   std::string_view("source_not_fused")};

struct Explanation {
  std::string_view why, remedy;
};

Explanation explain(StateReason reason) {
  switch (reason) {
    case StateReason::no_detections:
      return {"No detections arrived for longer than service.degraded_after_s.",
              "See that perception runs, and what else is found of detections."};
    case StateReason::no_poses:
      return {"No poses arrived for longer than service.degraded_after_s.",
              "See that odometry runs, and what else is found of poses."};
    case StateReason::unsynchronised:
      return {
          "Detections arrive that are not mapped, for want of poses around their stamps or for another "
          "reason.",
          "The counters detections_refused_<reason> say why (laneloom status)."};
    case StateReason::starting:
      return {"Nothing was mapped yet.", "See what keeps detections or poses from being mapped."};
    case StateReason::reset:
      return {"The map began anew a moment ago, as pose or stamps jumped.",
              "See whether two writers take turns, or a clock or localisation jumps."};
    case StateReason::overloaded:
      return {"Frames were dropped or had to wait, or a tick missed its deadline.", kLoad};
    case StateReason::another_service:
      return {"Another service publishes maps for the same vehicle, or on the same topic of ROS 2.",
              "End one of them, or give each vehicle an id and a ros2.namespace of its own."};
    case StateReason::outdated:
      return {
          "By their stamps, frames are mapped long after they were measured (service.degraded_lag_s): "
          "perception is late, however often it writes.",
          "See what holds perception up, or whether it stamps by another clock than odometry."};
    case StateReason::source_not_fused:
      return {"A source of detections that was heard a moment ago does not go into the map.",
              "See what else is found of it, and the sources in `laneloom status`."};
    case StateReason::sources_disagree:
      return {"Two sources of detections contradict each other by more than their deviations.",
              "See how their sensors are calibrated, and whether both stamp by one clock."};
    case StateReason::poses_jumped:
      return {"The poses jumped by less than the gate refuses, and the map was moved or cleared.",
              "Send continuous poses: odometry, not a localisation that corrects itself."};
    case StateReason::driving_side_contradicted:
      return {"Traffic keeps to the other side than mapper.direction.driving_side says.",
              "Set mapper.direction.driving_side to the side of the country."};
  }
  return {"This version of the doctor does not know it.", "See the log of the service."};
}

void judge_state(const ServiceStatus& status, Findings& found) {
  for (const StateReason reason : status.reasons) {
    const auto [why, remedy] = explain(reason);
    found.push_back({fmt::format("state_{}", name(reason)),
                     fmt::format("The service says {}: {}.", name(status.state), name(reason)),
                     std::string(why), std::string(remedy)});
  }
}

/// `subject` is detections, poses, objects, next_turns or datagrams.
Finding refusal(std::string_view by_whom, std::string_view subject, std::string_view reason,
                std::uint64_t count) {
  const bool at_the_door = subject == "datagrams";
  const Refusal why = at_the_door ? explain_refused_datagrams(reason) : explain_refusal(subject, reason);
  return {io::printable(fmt::format("{}_refused_{}", subject, reason)),
          io::printable(fmt::format("{} refused {} {} ({}): {}.", by_whom, count,
                                    subject == "next_turns" ? "turns" : subject, reason, why.cause)),
          at_the_door ? "What is refused does not reach DDS: nothing was done by it."
                      : "What is refused is not mapped.",
          std::string(why.remedy)};
}

void judge_counter(const std::string& counter, std::uint64_t rise, Findings& found) {
  constexpr std::string_view kRefused = "_refused_";
  const auto at = counter.find(kRefused);
  if (at != std::string::npos) {
    const std::string_view text = counter;
    found.push_back(refusal("The service", text.substr(0, at), text.substr(at + kRefused.size()), rise));
    return;
  }
  const auto* const known = std::ranges::find(kIncidents, counter, &Incident::counter);
  if (known == kIncidents.end()) return;
  found.push_back({counter, fmt::format("{}: {} ({} more).", counter, known->what, rise),
                   "The map lacks what they would have added.", std::string(known->remedy)});
}

/// Adds a finding if objects move, and none of them leaves a trail.
void judge_objects(const std::map<std::string, std::uint64_t>& rises, Findings& found) {
  const auto rise = [&](const char* counter) {
    const auto known = rises.find(counter);
    return known == rises.end() ? 0 : known->second;
  };
  const trails::MovingObjects moving{.believed = rise("objects_believed"),
                                     .without_heading = rise("objects_without_heading"),
                                     .doubted = rise("objects_doubted")};
  if (!moving.leave_no_trail()) return;
  found.push_back(
      {.id = "objects_leave_no_trail",
       .found =
           fmt::format("Of {} moving objects, {} have no heading, and {} are of unknown kind or not sure.",
                       moving.useless(), moving.without_heading, moving.doubted),
       .why = "None leaves a trail: other vehicles tell nothing of the lanes.",
       .remedy = "See what idl/README.md says of heading, kind, existence_probability and position_stddev_m.",
       .advice = true});
}

/// Adds the refusals by the doctor itself, if there is no service that could refuse.
void judge_own(const char* subject, const InputObserved& input, Findings& found) {
  for (const auto& [reason, count] : input.refused)
    found.push_back(refusal("The doctor, as the service would,", subject, reason, count));
}

/// Adds a finding if frames of a source arrive, but none goes into the map.
void judge_source(const SourceStatus& source, const ServiceStatus& first, Findings& found) {
  const auto before = std::ranges::find_if(first.sources, [&](const SourceStatus& other) {
    return other.source == source.source && other.session_id == source.session_id;
  });
  if (before == first.sources.end() || source.frames <= before->frames || source.fused > before->fused)
    return;
  found.push_back({"source_not_fused",
                   io::printable(fmt::format("Of source \"{}\", {} frames arrived and none was mapped.",
                                             source.source, source.frames - before->frames)),
                   "The map knows nothing of what this source sees.",
                   "See what is refused: no poses around its stamps, another clock, or stamps that repeat."});
}

}  // namespace

Findings incident_findings(const Observed& seen) {
  Findings found;
  if (seen.services.empty()) {
    judge_own("detections", seen.detections, found);
    judge_own("poses", seen.poses, found);
    judge_own("objects", seen.objects, found);
    judge_own("next_turns", seen.next_turns, found);
  }
  for (const ServiceObserved& service : seen.services) {
    const auto rises = status::rises(service.last, service.first);
    for (const auto& [counter, rise] : rises) judge_counter(counter, rise, found);
    judge_objects(rises, found);
    for (const SourceStatus& source : service.last.sources) judge_source(source, service.first, found);
  }
  std::stable_partition(found.begin(), found.end(), [](const Finding& finding) {
    return std::ranges::find(kConsequences, finding.id) == kConsequences.end();
  });
  return found;
}

Findings state_findings(const Observed& seen) {
  Findings found;
  if (seen.services.empty()) {
    const auto all = services(seen);
    const auto silent = std::ranges::find_if(
        all, [&](const auto& service) { return is_of_vehicle(service, seen.dds.vehicle_id); });
    const auto stopped = stopped_service(seen);
    if (silent != all.end() && stopped)
      found.push_back(*stopped);
    else if (silent != all.end())
      found.push_back({"service_silent",
                       fmt::format("{} publishes maps, but no status of it came within {:.1f} s.",
                                   who(silent->participant), seen.duration_s),
                       "It hangs, or its data does not arrive here.",
                       "See its log (journalctl -u laneloom). If it runs: a firewall may pass multicast "
                       "alone, or it sends by shared memory to processes that can't read it."});
  }
  for (const ServiceObserved& service : seen.services) judge_state(service.last, found);
  return found;
}

}  // namespace laneloom::doctor
