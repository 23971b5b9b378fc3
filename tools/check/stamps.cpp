#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "base/distribution.hpp"
#include "base/seconds.hpp"
#include "check/findings.hpp"

namespace laneloom::check {
namespace {

constexpr double kLongGap_s = 1.0, kGapPeriods = 5.0;  // a gap is longer than both
constexpr double kLongestPeriod_s = 0.7;
constexpr double kNoPeriod_s = 20.0;  // stamps that are no seconds: 20 ms is the shortest period
constexpr const char* kSort =
    "`laneloom import frames` puts them in order. Live, send them in the order of their stamps.";

/// The steps between stamps that ascend, and the number of those that do not.
struct Steps {
  std::vector<std::int64_t> stamps_ns{};  ///< ascending
  std::vector<double> steps_s{};
  std::size_t not_later = 0;
  std::int64_t first_not_later_ns = 0;
};

template <class Message>
Steps steps_of(const std::vector<Message>& messages) {
  Steps steps;
  for (const Message& message : messages) {
    if (steps.stamps_ns.empty() || message.stamp_ns > steps.stamps_ns.back())
      steps.stamps_ns.push_back(message.stamp_ns);
    else if (steps.not_later++ == 0)
      steps.first_not_later_ns = message.stamp_ns;
  }
  for (std::size_t i = 1; i < steps.stamps_ns.size(); ++i)
    steps.steps_s.push_back(seconds(steps.stamps_ns[i] - steps.stamps_ns[i - 1]));
  return steps;
}

void add_order(const Steps& steps, const std::string& what, Findings& found) {
  if (steps.not_later == 0) return;
  found.push_back(
      {what + "_out_of_order",
       fmt::format("{} {} are not later than one before (first: stamp {:.3f} s); they are refused.",
                   steps.not_later, what, seconds(steps.first_not_later_ns)),
       kSort});
}

void add_gaps(const Steps& steps, const std::string& what, Findings& found) {
  const double period_s = Distribution(steps.steps_s).quantile(0.5);
  const double longest_s = std::max(kLongGap_s, kGapPeriods * period_s);
  const auto gaps = std::ranges::count_if(steps.steps_s, [&](double step_s) { return step_s > longest_s; });
  if (gaps == 0) return;
  const auto longest = std::ranges::max_element(steps.steps_s);
  const auto before = static_cast<std::size_t>(longest - steps.steps_s.begin());
  found.push_back(
      {what + "_gap",
       fmt::format("There are {} gaps between {}, the longest of {:.1f} s after stamp {:.3f} s.", gaps, what,
                   *longest, seconds(steps.stamps_ns[before])),
       "The map is STALE meanwhile (service.stale_after_s). See what was lost, or cut the drive there."});
}

void add_rate(const Steps& steps, Findings& found) {
  const double period_s = Distribution(steps.steps_s).quantile(0.5);
  if (period_s <= kLongestPeriod_s) return;
  if (period_s >= kNoPeriod_s) {
    found.push_back({"stamps_not_seconds", fmt::format("Frames come every {:g} s.", period_s),
                     "Give stamps in seconds: these look like milliseconds, microseconds or nanoseconds."});
    return;
  }
  found.push_back({"frames_rare", fmt::format("Frames come every {:.2f} s.", period_s),
                   "laneloom is made for about 10 frames a second: a line is confirmed late, and "
                   "service.stale_after_s has to be longer."});
}

/// Frames that the poses around them are too far apart for.
void add_poses_apart(const std::vector<DetectionFrame>& frames, const Steps& poses, double max_gap_s,
                     Findings& found) {
  std::size_t apart = 0;
  for (const DetectionFrame& frame : frames) {
    const auto next = std::ranges::lower_bound(poses.stamps_ns, frame.stamp_ns);
    const bool inside =
        next != poses.stamps_ns.end() && next != poses.stamps_ns.begin() && *next != frame.stamp_ns;
    if (inside && seconds(*next - *std::prev(next)) > max_gap_s) ++apart;
  }
  if (5 * apart <= frames.size()) return;
  found.push_back({"poses_rare",
                   fmt::format("{} of {} frames lie between poses more than {:g} s apart; they are refused.",
                               apart, frames.size(), max_gap_s),
                   fmt::format("Give poses more often, or set sync.max_pose_gap_s to {:.1f}.",
                               1.2 * Distribution(poses.steps_s).quantile(0.95))});
}

}  // namespace

Findings frame_stamp_findings(const std::vector<DetectionFrame>& frames,
                              const std::vector<VehiclePose>& poses, const SyncConfig& sync) {
  Findings found;
  const Steps steps = steps_of(frames);
  add_order(steps, "frames", found);
  add_poses_apart(frames, steps_of(poses), sync.max_pose_gap_s, found);
  add_gaps(steps, "frames", found);
  add_rate(steps, found);
  return found;
}

Findings pose_stamp_findings(const std::vector<VehiclePose>& poses) {
  Findings found;
  const Steps steps = steps_of(poses);
  add_order(steps, "poses", found);
  add_gaps(steps, "poses", found);
  return found;
}

}  // namespace laneloom::check
