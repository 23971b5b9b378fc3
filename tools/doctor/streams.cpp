#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/seconds.hpp"
#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"
#include "doctor/ros2.hpp"
#include "laneloom/dds/topics.hpp"
#include "status/report.hpp"

namespace laneloom::doctor {
namespace {

constexpr double kMinWindow_s = 1.0;  ///< a shorter window tells no rate
constexpr double kMinDetections_hz = 4.0, kMaxDetections_hz = 50.0, kMinPoses_hz = 20.0;
constexpr double kMinObjects_hz = 2.0;  ///< a trail ends where nothing comes for a second
constexpr double kMaxClockOffset_s = 0.5;
constexpr std::uint32_t kLargestDatagram = 65500;  ///< that participants send by default, in bytes

/// A stream of messages that one writer should write.
struct Stream {
  const char* input;  ///< the input that it belongs to
  std::string what;
  const InputObserved* messages;
};

/// The streams of detections, one for each source. If no message is well formed, one for all.
std::vector<Stream> detections(const Observed& seen) {
  if (seen.sources.empty()) return {{"detections", "detections", &seen.detections}};
  std::vector<Stream> result;
  for (const auto& [name, messages] : seen.sources)
    result.push_back(
        {"detections",
         seen.sources.size() == 1 ? "detections" : fmt::format("detections of source \"{}\"", name),
         &messages});
  return result;
}

void judge_numbers(const Stream& stream, Findings& found) {
  if (stream.messages->unnumbered < 2) return;
  found.push_back({fmt::format("{}_unnumbered", stream.input),
                   fmt::format("{} {} have the sequence_number of the one before.",
                               stream.messages->unnumbered, stream.what),
                   "Losses cannot be told, nor which frames a map was made of.",
                   "Count sequence_number up by one with each message."});
}

Finding slow(std::string_view input, const std::string& what, double rate_hz, double min_hz) {
  return {fmt::format("{}_slow", input),
          fmt::format("{:.1f} {} come in a second; it should be {} at least.", rate_hz, what, min_hz),
          "Frames are only mapped between two poses at most sync.max_pose_gap_s apart; without "
          "new ones, the map gets stale.",
          "See whether their writer is overloaded, or the network loses them (counters *_lost)."};
}

void judge_slow(const Stream& stream, double min_hz, Findings& found) {
  const InputObserved& observed = *stream.messages;
  if (observed.messages == 0 || observed.window_s < kMinWindow_s) return;
  // The window ends between two messages, so that one message more must not decide.
  const double messages = static_cast<double>(observed.messages);
  if ((messages + 1.0) / observed.window_s < min_hz)
    found.push_back(slow(stream.input, stream.what, (messages - 1.0) / observed.window_s, min_hz));
}

/// Judges the rates of what nodes of ROS 2 write. The service counts these messages, and the doctor does not
/// read them.
void judge_counted(const Observed& seen, Findings& found) {
  if (seen.services.empty()) return;
  const ServiceObserved& service = seen.services.back();
  const double window_s = seconds(service.last.published_ns) - seconds(service.first.published_ns);
  if (window_s < kMinWindow_s) return;
  const auto rises = status::rises(service.last, service.first);
  const auto judge = [&](const std::string& input, const InputObserved& own, double min_hz) {
    const auto rise = rises.find(input + "_received");
    const double messages = rise == rises.end() ? 0.0 : static_cast<double>(rise->second);
    if (own.messages == 0 && (messages + 1.0) / window_s < min_hz)
      found.push_back(slow(input, input, messages / window_s, min_hz));
  };
  if (ros_writes_detections(seen)) judge("detections", seen.detections, kMinDetections_hz);
  if (ros_writes_poses(seen)) judge("poses", seen.poses, kMinPoses_hz);
  if (ros_writes_objects(seen)) judge("objects", seen.objects, kMinObjects_hz);
}

void judge_fast(const InputObserved& frames, Findings& found) {
  if (frames.messages == 0 || frames.window_s < kMinWindow_s) return;
  const double rate_hz = (static_cast<double>(frames.messages) - 1.0) / frames.window_s;
  if (rate_hz <= kMaxDetections_hz) return;
  found.push_back({"detections_fast",
                   fmt::format("{:.1f} detections come in a second; it should be {} at most.", rate_hz,
                               kMaxDetections_hz),
                   "The service drops what it can't map in time.",
                   "See whether several writers publish for this vehicle, or one publishes in bursts."});
}

/// The writers that the service reads, which are also of the right type.
std::vector<dds::Endpoint> writers(const Observed& seen, const char* topic, const char* type) {
  return select(seen, [&](const dds::Endpoint& endpoint) {
    return endpoint.is_writer && endpoint.topic == topic && endpoint.type == type &&
           is_of_vehicle(endpoint, seen.dds.vehicle_id);
  });
}

void judge_silence(const std::vector<dds::Endpoint>& writers, const char* what, const InputObserved& messages,
                   double duration_s, Findings& found) {
  if (writers.empty() || messages.messages > 0) return;
  found.push_back({fmt::format("{}_silent", what),
                   fmt::format("{} writes {}, but none came within {:.1f} s.", who(writers[0].participant),
                               what, duration_s),
                   "It is known, so discovery works; its data does not arrive, or it writes none.",
                   "See whether it gets data itself. If it does: a firewall may pass multicast alone, a "
                   "host may announce an address that is out of reach, or it sends by shared memory to "
                   "processes that can't read it (another user, a container)."});
}

void judge_detections(const Observed& seen, Findings& found) {
  judge_silence(writers(seen, dds::kDetectionsTopic, dds::kDetectionsType), "detections", seen.detections,
                seen.duration_s, found);
  for (const Stream& stream : detections(seen)) {
    judge_slow(stream, kMinDetections_hz, found);
    judge_numbers(stream, found);
  }
  judge_fast(seen.detections, found);
}

void judge_poses(const Observed& seen, Findings& found) {
  const auto all = writers(seen, dds::kVehiclePoseTopic, dds::kVehiclePoseType);
  judge_silence(all, "poses", seen.poses, seen.duration_s, found);
  if (all.size() > 1)
    found.push_back({"poses_two_writers",
                     fmt::format("{} and {} both write poses of this vehicle.", who(all[0].participant),
                                 who(all[1].participant)),
                     "Where their messages differ, each takes the other for a jump, and the map begins anew.",
                     "End one of them, or give each vehicle an id of its own."});
  const Stream stream{"poses", "poses", &seen.poses};
  judge_slow(stream, kMinPoses_hz, found);
  judge_numbers(stream, found);
}

/// The time from arrival to stamp, in seconds. The two clocks may differ.
double offset_s(const InputObserved::Newest& newest) {
  return seconds(newest.stamp_ns) - seconds(newest.arrival_ns);
}

void judge_sensor_clock(const Stream& stream, const InputObserved& poses, Findings& found) {
  if (!stream.messages->newest || !poses.newest) return;
  const double apart_s = offset_s(*stream.messages->newest) - offset_s(*poses.newest);
  if (std::abs(apart_s) <= kMaxClockOffset_s) return;
  found.push_back(
      {"sensor_clocks",
       fmt::format("Stamps of {} are {:.1f} s {} those of poses.", stream.what, std::abs(apart_s),
                   apart_s < 0.0 ? "behind" : "ahead of"),
       "A frame needs the poses around its stamp, from the same clock; it waits for them no longer "
       "than sync.max_wait_s.",
       "Stamp both by one clock, at the time of measurement: synchronise the hosts (PTP, chrony), "
       "and see whether one of them uses the time of sending, or of its start."});
}

void judge_objects(const Observed& seen, Findings& found) {
  judge_silence(writers(seen, dds::kObjectsTopic, dds::kObjectsType), "objects", seen.objects,
                seen.duration_s, found);
  const Stream stream{"objects", "objects", &seen.objects};
  judge_slow(stream, kMinObjects_hz, found);
  judge_numbers(stream, found);
  judge_sensor_clock(stream, seen.poses, found);
}

/// A navigation without a route is silent.
void judge_next_turns(const Observed& seen, Findings& found) {
  const Stream stream{"next_turns", "turns", &seen.next_turns};
  judge_numbers(stream, found);
  judge_sensor_clock(stream, seen.poses, found);
}

Finding datagrams_cut(std::uint32_t bytes, const std::string& profile_file) {
  return {"datagrams_cut",
          fmt::format("Datagrams of more than {} bytes are cut when they are received, and lost without a "
                      "word (maxMessageSize in {}).",
                      bytes, profile_file),
          "Other participants send up to 65500 bytes in one, and so every large frame would be missing.",
          "Leave maxMessageSize out of the profile: Fast DDS receives into a buffer of that size."};
}

/// Judges the datagrams of the doctor's settings and of the service's, which may differ.
void judge_datagrams(const Observed& seen, Findings& found) {
  if (seen.largest_datagram < kLargestDatagram)
    found.push_back(datagrams_cut(seen.largest_datagram, seen.dds.profile_file));
  for (const ServiceObserved& service : seen.services) {
    if (!service.largest_datagram)
      found.push_back(
          {"profile_unread",
           fmt::format("The DDS profile of the service cannot be read here: {}.", service.profile_file),
           "It may cut large datagrams, or send where nobody is.",
           "Run the doctor on the service's host, as a user who may read it.", true});
    else if (*service.largest_datagram < kLargestDatagram)
      found.push_back(datagrams_cut(*service.largest_datagram, service.profile_file));
  }
}

void judge_host_clocks(const Observed& seen, Findings& found) {
  for (const ServiceObserved& service : seen.services) {
    // The first status may be an old one that was kept for late readers.
    if (service.statuses < 2 || std::abs(service.clock_offset_s) <= kMaxClockOffset_s) continue;
    found.push_back(
        {"host_clocks",
         fmt::format("The system clock of the service's host is {:.1f} s {} the one here.",
                     std::abs(service.clock_offset_s), service.clock_offset_s > 0.0 ? "behind" : "ahead of"),
         "What is stamped by the one and the other does not fit together; nor do logs.",
         "Synchronise the hosts (PTP, chrony)."});
  }
}

}  // namespace

Findings stream_findings(const Observed& seen) {
  Findings found;
  judge_detections(seen, found);
  judge_poses(seen, found);
  judge_objects(seen, found);
  judge_next_turns(seen, found);
  judge_counted(seen, found);
  judge_datagrams(seen, found);
  for (const Stream& stream : detections(seen)) judge_sensor_clock(stream, seen.poses, found);
  judge_host_clocks(seen, found);
  return found;
}

}  // namespace laneloom::doctor
