#include "check/drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "session/pose_buffer.hpp"

namespace laneloom::check {
namespace {

constexpr std::int64_t kLongestGap_ns = 2'000'000'000;
constexpr std::int64_t kOutOfOrder_ns =
    1'000'000'000;  // a message that comes later than that is of another run
constexpr std::size_t kShortestRun = 20;

/// Whether a pose repeats another one, as it does in JSON lines where two sources have frames at its stamp.
bool are_equal(const VehiclePose& a, const VehiclePose& b) {
  return a.stamp_ns == b.stamp_ns && a.session_id == b.session_id && a.position == b.position &&
         a.orientation.coeffs() == b.orientation.coeffs();
}

}  // namespace

Drive read_drive(replay::MessageSource& source, const std::function<void(double share)>& on_step) {
  Drive drive;
  while (std::optional<recording::RecordedMessage> message = source.next_input()) {
    if (const auto* pose = std::get_if<VehiclePose>(&message->message))
      if (drive.poses.empty() || !are_equal(*pose, drive.poses.back())) drive.poses.push_back(*pose);
    if (auto* frame = std::get_if<DetectionFrame>(&message->message))
      drive.frames[frame->source].push_back(std::move(*frame));
    if (auto* objects = std::get_if<TrackedObjects>(&message->message))
      drive.objects.push_back(std::move(*objects));
    if (const auto* turn = std::get_if<NextTurn>(&message->message)) drive.next_turns.push_back(*turn);
    on_step(source.progress());
  }
  return drive;
}

std::vector<std::size_t> later_runs(const std::vector<VehiclePose>& poses) {
  std::vector<std::size_t> begins;
  std::size_t begin = 0;
  const auto is_run_until = [&](std::size_t end) { return end - begin >= kShortestRun; };
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (poses[i - 1].stamp_ns - poses[i].stamp_ns <= kOutOfOrder_ns) continue;
    if (!is_run_until(i)) return {};
    begins.push_back(begin = i);
  }
  return is_run_until(poses.size()) ? begins : std::vector<std::size_t>{};
}

PoseTrack::PoseTrack(std::vector<VehiclePose> poses) : poses_(std::move(poses)) {
  std::ranges::stable_sort(poses_, {}, &VehiclePose::stamp_ns);
  const auto same = [](const VehiclePose& a, const VehiclePose& b) { return a.stamp_ns == b.stamp_ns; };
  poses_.erase(std::unique(poses_.begin(), poses_.end(), same), poses_.end());
}

std::optional<Eigen::Isometry3d> PoseTrack::at(std::int64_t stamp_ns, const Correction& correction) const {
  stamp_ns -= std::llround(correction.pose_time_s * 1e9);
  const auto next = std::ranges::lower_bound(poses_, stamp_ns, {}, &VehiclePose::stamp_ns);
  if (next == poses_.end()) return std::nullopt;
  const VehiclePose after = corrected(*next, correction);
  if (next->stamp_ns == stamp_ns) return transform(after);
  if (next == poses_.begin() || next->stamp_ns - std::prev(next)->stamp_ns > kLongestGap_ns)
    return std::nullopt;
  const VehiclePose before = corrected(*std::prev(next), correction);
  const double share = static_cast<double>(stamp_ns - std::prev(next)->stamp_ns) /
                       static_cast<double>(next->stamp_ns - std::prev(next)->stamp_ns);
  return Eigen::Translation3d(before.position + share * (after.position - before.position)) *
         session::slerp(before.orientation, after.orientation, share);
}

}  // namespace laneloom::check
