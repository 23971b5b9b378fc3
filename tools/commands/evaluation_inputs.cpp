#include "commands/evaluation_inputs.hpp"

#include <optional>
#include <utility>
#include <variant>

#include "io/json_lines.hpp"
#include "laneloom/recording.hpp"
#include "service/gate.hpp"
#include "service/synchroniser.hpp"

namespace laneloom {
namespace {

using VisitFrame = std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>;
using VisitMap = std::function<void(const LocalMap&)>;

/// Gives each frame of a recording its pose.
class RecordedFrames {
 public:
  explicit RecordedFrames(const VisitFrame& visit) : visit_(visit) {}

  void add(const VehiclePose& pose) {
    if (!defect(pose, gate_config_).empty()) return;
    const Gate::Verdict verdict = pose_gate_.check({pose.stamp_ns, pose.session_id, pose.position});
    if (verdict == Gate::Verdict::begins_anew) synchroniser_.clear_poses();
    if (verdict == Gate::Verdict::accepted || verdict == Gate::Verdict::begins_anew) synchroniser_.add(pose);
    visit_ready();
  }

  void add(DetectionFrame&& frame) {
    if (!defect(frame, gate_config_).empty()) return;
    synchroniser_.add(PendingFrame{.frame = std::move(frame)});
    visit_ready();
    synchroniser_.drop_excess();
  }

 private:
  void visit_ready() {
    std::size_t without_pose = 0;
    while (const auto ready = synchroniser_.next(without_pose)) {
      const DetectionFrame& frame = ready->pending.frame;
      if (last_stamp_ns_ && frame.stamp_ns <= *last_stamp_ns_) continue;
      last_stamp_ns_ = frame.stamp_ns;
      visit_(frame, ready->T_map_body);
    }
  }

  const VisitFrame& visit_;
  GateConfig gate_config_;
  Gate pose_gate_{gate_config_};
  Synchroniser synchroniser_{SyncConfig{}};
  std::optional<std::int64_t> last_stamp_ns_;
};

/// A map on the wire may have lines of less than two points, with which nothing can be compared.
void drop_degenerate_lines(LocalMap& map) {
  const auto degenerate = [](const Polyline& points) { return points.size() < 2; };
  std::erase_if(map.boundaries, [&](const Marking& boundary) { return degenerate(boundary.points); });
  std::erase_if(map.stoplines, [&](const Stopline& stopline) { return degenerate(stopline.marking.points); });
  std::erase_if(map.lanes, [&](const Lane& lane) {
    return degenerate(lane.left) || degenerate(lane.right) || degenerate(lane.centerline);
  });
}

void for_each_recorded_map(const std::filesystem::path& path, const VisitMap& visit) {
  RecordingReader reader(path.string());
  std::optional<LocalMap> newest;  // another of its stamp may follow
  while (auto recorded = reader.next()) {
    auto* published = std::get_if<PublishedMap>(&recorded->message);
    if (published == nullptr || published->map.stamp_ns == 0) continue;
    if (newest && published->map.stamp_ns < newest->stamp_ns) continue;
    if (newest && published->map.stamp_ns > newest->stamp_ns) visit(*newest);
    newest = std::move(published->map);
    drop_degenerate_lines(*newest);
  }
  if (newest) visit(*newest);
}

}  // namespace

void for_each_frame(const std::filesystem::path& path, const VisitFrame& visit) {
  if (is_recording(path)) {
    RecordingReader reader(path.string());
    RecordedFrames frames(visit);
    while (auto recorded = reader.next()) {
      if (const auto* pose = std::get_if<VehiclePose>(&recorded->message)) frames.add(*pose);
      if (auto* frame = std::get_if<DetectionFrame>(&recorded->message)) frames.add(std::move(*frame));
    }
    return;
  }
  JsonLinesReader in(path);
  while (const auto record = in.next_frame()) visit(record->frame, transform(record->pose));
}

void for_each_map(const std::filesystem::path& path, const VisitMap& visit) {
  if (is_recording(path)) {
    for_each_recorded_map(path, visit);
    return;
  }
  JsonLinesReader in(path);
  while (const auto map = in.next_map()) visit(*map);
}

}  // namespace laneloom
