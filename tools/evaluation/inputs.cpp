#include "evaluation/inputs.hpp"

#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "io/json_lines.hpp"
#include "recording/damage.hpp"
#include "recording/recording.hpp"
#include "session/gate.hpp"
#include "session/synchroniser.hpp"

namespace laneloom::evaluation {
namespace {

using VisitFrame = std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>;
using VisitMap = std::function<void(const LocalMap&)>;

/// Passes on frames that are later than all before them.
class Ascending {
 public:
  explicit Ascending(const VisitFrame& visit) : visit_(visit) {}
  void operator()(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
    if (frame.stamp_ns <= last_stamp_ns_) return;
    last_stamp_ns_ = frame.stamp_ns;
    visit_(frame, T_map_body);
  }

 private:
  const VisitFrame& visit_;
  std::int64_t last_stamp_ns_ = std::numeric_limits<std::int64_t>::min();
};

/// Gives each frame of a recording its pose.
class RecordedFrames {
 public:
  explicit RecordedFrames(const VisitFrame& visit) : visit_(visit) {}

  void add(const VehiclePose& pose) {
    if (!session::defect(pose, gate_config_).empty()) return;
    const session::Gate::Verdict verdict = pose_gate_.check({pose.stamp_ns, pose.session_id, pose.position});
    if (verdict == session::Gate::Verdict::begins_anew) synchroniser_.clear_poses();
    if (verdict == session::Gate::Verdict::accepted || verdict == session::Gate::Verdict::begins_anew)
      synchroniser_.add(pose);
    visit_ready();
  }

  void add(DetectionFrame&& frame) {
    if (!session::defect(frame, gate_config_).empty()) return;
    synchroniser_.add(session::PendingFrame{.frame = std::move(frame)});
    visit_ready();
    synchroniser_.drop_excess();
  }

 private:
  void visit_ready() {
    std::size_t without_pose = 0;
    while (const auto ready = synchroniser_.next(without_pose))
      visit_(ready->pending.frame, ready->T_map_body);
  }

  Ascending visit_;
  GateConfig gate_config_;
  session::Gate pose_gate_{gate_config_};
  session::Synchroniser synchroniser_{SyncConfig{}};
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

/// Passes on the last map of each stamp.
class NewestMaps {
 public:
  explicit NewestMaps(const VisitMap& visit) : visit_(visit) {}
  void add(LocalMap&& map) {
    if (map.stamp_ns == 0 || (newest_ && map.stamp_ns < newest_->stamp_ns)) return;
    if (newest_ && map.stamp_ns > newest_->stamp_ns) visit_(*newest_);
    newest_ = std::move(map);
    drop_degenerate_lines(*newest_);
  }
  void finish() {
    if (newest_) visit_(*newest_);
  }

 private:
  const VisitMap& visit_;
  std::optional<LocalMap> newest_;  // another of its stamp may follow
};

}  // namespace

InputAccount for_each_frame(const std::filesystem::path& path, const VisitFrame& visit,
                            const InputReading& reading) {
  InputAccount account{.left_out = LeftOut(reading.strict)};
  if (recording::is_recording(path)) {
    recording::RecordingReader reader(path.string());
    RecordedFrames frames(visit);
    while (auto recorded = recording::next_or_leave_out(account.left_out, [&] { return reader.next(); })) {
      reading.on_step(reader.progress());
      if (const auto* pose = std::get_if<VehiclePose>(&recorded->message)) frames.add(*pose);
      auto* frame = std::get_if<DetectionFrame>(&recorded->message);
      if (frame == nullptr) continue;
      ++account.count;
      frames.add(std::move(*frame));
    }
    account.refused = reader.refused();
    account.cut_off = reader.cut_off();
    return account;
  }
  io::JsonLinesReader in(path);
  Ascending ascending(visit);
  for (; const auto record = in.next_frame(account.left_out); ++account.count) {
    reading.on_step(in.progress());
    ascending(record->frame, transform(record->pose));
  }
  return account;
}

InputAccount for_each_map(const std::filesystem::path& path, const VisitMap& visit,
                          const InputReading& reading) {
  InputAccount account{.left_out = LeftOut(reading.strict)};
  NewestMaps maps(visit);
  if (recording::is_recording(path)) {
    recording::RecordingReader reader(path.string());
    while (auto recorded = recording::next_or_leave_out(account.left_out, [&] { return reader.next(); })) {
      reading.on_step(reader.progress());
      auto* published = std::get_if<PublishedMap>(&recorded->message);
      if (published == nullptr) continue;
      ++account.count;
      maps.add(std::move(published->map));
    }
    account.refused = reader.refused();
    account.cut_off = reader.cut_off();
  } else {
    io::JsonLinesReader in(path);
    for (; auto map = in.next_map(account.left_out); ++account.count) {
      reading.on_step(in.progress());
      maps.add(std::move(*map));
    }
  }
  maps.finish();
  return account;
}

}  // namespace laneloom::evaluation
