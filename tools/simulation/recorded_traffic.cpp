#include "simulation/recorded_traffic.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/seconds.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kRemembered_s = 0.15;  // sweeps are 0.1 s apart

}  // namespace

RecordedTraffic::RecordedTraffic(std::vector<TrackedObjects> objects, const Drive& drive,
                                 std::int64_t start_ns)
    : seen_(std::move(objects)) {
  for (TrackedObjects& seen : seen_) {
    seen.stamp_ns -= start_ns;
    seen = in_map_frame(std::move(seen), transform(drive.pose_at(seconds(seen.stamp_ns))));
  }
}

TrackedObjects RecordedTraffic::observe(const VehiclePose& pose, double drive_s) {
  const std::int64_t now_ns = std::llround(drive_s * 1e9);
  const auto next = std::ranges::upper_bound(seen_, now_ns, {}, &TrackedObjects::stamp_ns);
  TrackedObjects now{.objects = {}, .in_map_frame = true};
  if (next != seen_.begin() && seconds(now_ns - std::prev(next)->stamp_ns) <= kRemembered_s)
    now = moved_to(now_ns, *std::prev(next));
  now.stamp_ns = pose.stamp_ns;
  now.sequence = ++sequence_;
  now.session_id = 1;
  return in_body_frame(std::move(now), transform(pose));
}

}  // namespace laneloom::simulation
