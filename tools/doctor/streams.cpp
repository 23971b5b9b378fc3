#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"
#include "laneloom/dds/topics.hpp"

namespace laneloom {
namespace {

constexpr double kMinWindow_s = 1.0;  ///< to tell a rate from
constexpr double kAnyRate_hz = std::numeric_limits<double>::infinity();
constexpr double kMaxClockOffset_s = 0.5;

struct Input {
  const char* what;
  const char* topic;
  const InputObserved& messages;
  double min_rate_hz, max_rate_hz;
  bool one_writer;
};

void judge_numbers(const Input& input, Findings& found) {
  if (input.messages.unnumbered < 2) return;
  found.push_back({fmt::format("{}_unnumbered", input.what),
                   fmt::format("{} {} have the sequence_number of the one before.", input.messages.unnumbered,
                               input.what),
                   "Losses cannot be told, nor which frames a map was made of.",
                   "Count sequence_number up by one with each message."});
}

void judge_rate(const Input& input, Findings& found) {
  if (input.messages.messages == 0 || input.messages.window_s < kMinWindow_s) return;
  // The window ends between two messages: one of them more or less decides nothing.
  const double messages = static_cast<double>(input.messages.messages);
  const double rate_hz = (messages - 1.0) / input.messages.window_s;
  if ((messages + 1.0) / input.messages.window_s < input.min_rate_hz)
    found.push_back({fmt::format("{}_slow", input.what),
                     fmt::format("{:.1f} {} come in a second; it should be {} at least.", rate_hz, input.what,
                                 input.min_rate_hz),
                     "Frames are only mapped between two poses at most sync.max_pose_gap_s apart; without "
                     "new ones, the map gets stale.",
                     "See whether their writer is overloaded, or the network loses them (counters *_lost)."});
  if (rate_hz > input.max_rate_hz)
    found.push_back({fmt::format("{}_fast", input.what),
                     fmt::format("{:.1f} {} come in a second; it should be {} at most.", rate_hz, input.what,
                                 input.max_rate_hz),
                     "The service drops what it can't map in time.",
                     "See whether several writers publish for this vehicle, or one publishes in bursts."});
}

void judge(const Observed& seen, const Input& input, Findings& found) {
  const auto writers = select(seen, [&](const dds::Endpoint& endpoint) {
    return endpoint.is_writer && endpoint.topic == input.topic &&
           is_of_vehicle(endpoint, seen.dds.vehicle_id);
  });
  if (!writers.empty() && input.messages.messages == 0)
    found.push_back({fmt::format("{}_silent", input.what),
                     fmt::format("{} writes {}, but none came within {:.1f} s.", who(writers[0].participant),
                                 input.what, seen.duration_s),
                     "It is known, so discovery works; its data does not arrive, or it writes none.",
                     "See whether it gets data itself. If it does: a firewall may pass multicast alone, a "
                     "host may announce an address that is out of reach, or it sends by shared memory to "
                     "processes that can't read it (another user, a container)."});
  if (writers.size() > 1 && input.one_writer)
    found.push_back({fmt::format("{}_two_writers", input.what),
                     fmt::format("{} and {} both write {} of this vehicle.", who(writers[0].participant),
                                 who(writers[1].participant), input.what),
                     "Where their messages differ, each takes the other for a jump, and the map begins anew.",
                     "End one of them, or give each vehicle an id of its own."});
  judge_rate(input, found);
  judge_numbers(input, found);
}

void judge_datagrams(const Observed& seen, Findings& found) {
  constexpr std::uint32_t kLargest = 65500;  // bytes that participants send by default
  if (seen.largest_datagram >= kLargest) return;
  found.push_back(
      {"datagrams_cut",
       fmt::format("Datagrams of more than {} bytes are cut when they are received, and lost without a "
                   "word (maxMessageSize in {}).",
                   seen.largest_datagram, seen.dds.profile_file),
       "Other participants send up to 65500 bytes in one, and so every large frame would be missing.",
       "Leave maxMessageSize out of the profile: Fast DDS receives into a buffer of that size."});
}

void judge_view(const Observed& seen, Findings& found) {
  const InputObserved& frames = seen.detections;
  const std::uint64_t refused =
      std::accumulate(frames.refused.begin(), frames.refused.end(), std::uint64_t{0},
                      [](auto sum, const auto& entry) { return sum + entry.second; });
  if (frames.without_view == 0 || frames.without_view + refused < frames.messages) return;
  found.push_back(
      {"no_field_of_view", "Detections come without a field of view.",
       "Where nothing is seen, the mapper cannot tell a line that is gone from one out of sight.",
       "Fill Detections.field_of_view with what the sensors cover, and occluded_areas where they are "
       "blocked.",
       true});
}

/// Stamp against arrival, in seconds.
double offset_s(const InputObserved::Newest& newest) {
  return static_cast<double>(newest.stamp_ns) / 1e9 - static_cast<double>(newest.arrival_ns) / 1e9;
}

void judge_sensor_clock(const Observed& seen, Findings& found) {
  if (!seen.detections.newest || !seen.poses.newest) return;
  const double apart_s = offset_s(*seen.detections.newest) - offset_s(*seen.poses.newest);
  if (std::abs(apart_s) <= kMaxClockOffset_s) return;
  found.push_back(
      {"sensor_clocks",
       fmt::format("Stamps of detections are {:.1f} s {} those of poses.", std::abs(apart_s),
                   apart_s < 0.0 ? "behind" : "ahead of"),
       "A frame needs the poses around its stamp, from the same clock; it waits for them no longer "
       "than sync.max_wait_s.",
       "Stamp both by one clock, at the time of measurement: synchronise the hosts (PTP, chrony), "
       "and see whether one of them uses the time of sending, or of its start."});
}

void judge_host_clocks(const Observed& seen, Findings& found) {
  for (const ServiceObserved& service : seen.services) {
    // The first may be one that was kept for late joiners.
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
  judge(seen, {"detections", dds::kDetectionsTopic, seen.detections, 4.0, 50.0, false}, found);
  judge(seen, {"poses", dds::kVehiclePoseTopic, seen.poses, 20.0, kAnyRate_hz, true}, found);
  judge_datagrams(seen, found);
  judge_sensor_clock(seen, found);
  judge_host_clocks(seen, found);
  judge_view(seen, found);
  return found;
}

}  // namespace laneloom
