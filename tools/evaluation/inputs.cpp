#include "evaluation/inputs.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "io/json_lines.hpp"
#include "io/leave_out.hpp"
#include "recording/damage.hpp"
#include "recording/recording.hpp"
#include "session/gate.hpp"
#include "session/pending_messages.hpp"
#include "session/synchroniser.hpp"

namespace laneloom::evaluation {
namespace {

using VisitFrame = std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>;
template <class T>
using Visit = std::function<void(const T&, const Eigen::Isometry3d&)>;
using VisitMap = std::function<void(const LocalMap&)>;

/// Passes on frames in the order of their stamps, and one of each source at a stamp.
class Ascending {
 public:
  Ascending(const VisitFrame& visit, LeftOut& left_out) : visit_(visit), left_out_(left_out) {}
  void operator()(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
    if (frame.stamp_ns > newest_ns_) sources_.clear();
    if (frame.stamp_ns < newest_ns_ || !sources_.insert(frame.source).second)
      return io::leave_out(left_out_, "a frame is not later than one before it", frame.stamp_ns);
    newest_ns_ = frame.stamp_ns;
    visit_(frame, T_map_body);
  }

 private:
  const VisitFrame& visit_;
  LeftOut& left_out_;
  std::int64_t newest_ns_ = std::numeric_limits<std::int64_t>::min();
  std::set<std::string> sources_;  ///< of the frames at the newest stamp
};

/// The poses of a recording that a service would believe, and what waits for them.
class RecordedPoses {
 public:
  void add(const VehiclePose& pose) {
    if (!session::defect(pose, gate_config_).empty()) return;
    const session::Gate::Verdict verdict = gate_.check({pose.stamp_ns, pose.session_id, pose.position});
    if (verdict == session::Gate::Verdict::begins_anew) synchroniser.clear_poses();
    if (verdict != session::Gate::Verdict::accepted && verdict != session::Gate::Verdict::begins_anew) return;
    synchroniser.add(pose);
    newest_ns = pose.stamp_ns;
  }

  session::Synchroniser synchroniser{SyncConfig{}};
  std::optional<std::int64_t> newest_ns;

 private:
  GateConfig gate_config_;
  session::Gate gate_{gate_config_};
};

/// Gives each frame of a recording its pose.
class RecordedFrames {
 public:
  RecordedFrames(const VisitFrame& visit, LeftOut& left_out) : visit_(visit, left_out) {}

  void add(const VehiclePose& pose) {
    poses_.add(pose);
    visit_ready();
  }

  void add(DetectionFrame&& frame) {
    if (!session::defect(frame, GateConfig{}).empty()) return;
    poses_.synchroniser.add(session::PendingFrame{.frame = std::move(frame)});
    visit_ready();
    poses_.synchroniser.drop_excess();
  }

 private:
  void visit_ready() {
    std::size_t without_pose = 0;
    while (const auto ready = poses_.synchroniser.next(without_pose))
      visit_(ready->pending.frame, ready->T_map_body);
  }

  Ascending visit_;
  RecordedPoses poses_;
};

/// Gives all messages of type T of a recording their poses: TrackedObjects or NextTurn.
template <class T>
class RecordedOthers {
 public:
  explicit RecordedOthers(const Visit<T>& visit) : visit_(visit) {}

  void add(const VehiclePose& pose) {
    poses_.add(pose);
    visit_ready();
  }

  void add(T&& message) {
    if (!session::defect(message, GateConfig{}).empty()) return;
    pending_.add(std::move(message), poses_.newest_ns);
    pending_.drop_excess();
  }

  /// Visits what is no newer than the poses.
  void visit_ready() {
    if (!poses_.newest_ns) return;
    Eigen::Isometry3d T_map_body;
    while (const auto message = pending_.take_until(*poses_.newest_ns))
      if (poses_.synchroniser.pose_at(message->stamp_ns, T_map_body) == session::PoseBuffer::Answer::found)
        visit_(*message, T_map_body);
  }

 private:
  const Visit<T>& visit_;
  RecordedPoses poses_;
  session::PendingMessages<T> pending_{Config{}};
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
  NewestMaps(const VisitMap& visit, LeftOut& left_out) : visit_(visit), left_out_(left_out) {}
  void add(LocalMap&& map) {
    if (map.stamp_ns == 0) return;
    if (newest_ && map.stamp_ns < newest_->stamp_ns)
      return io::leave_out(left_out_, "a map is earlier than one before it", map.stamp_ns);
    if (newest_ && map.stamp_ns > newest_->stamp_ns) visit_(*newest_);
    newest_ = std::move(map);
    drop_degenerate_lines(*newest_);
  }
  void finish() {
    if (newest_) visit_(*newest_);
  }

 private:
  const VisitMap& visit_;
  LeftOut& left_out_;
  std::optional<LocalMap> newest_;  // another of its stamp may follow
};

/// Hands the poses of a recording to `taker`, and its messages of type T, which it counts.
template <class T, class Taker>
void read_recorded(const std::filesystem::path& path, const InputReading& reading, Taker& taker,
                   InputAccount& account) {
  recording::RecordingReader reader(path.string());
  while (auto recorded = recording::next_or_leave_out(account.left_out, [&] { return reader.next(); })) {
    reading.on_step(reader.progress());
    if (const auto* pose = std::get_if<VehiclePose>(&recorded->message)) taker.add(*pose);
    auto* message = std::get_if<T>(&recorded->message);
    if (message == nullptr) continue;
    ++account.count;
    taker.add(std::move(*message));
  }
  account.refused = reader.refused();
}

/// Hands the frames of a file of JSON lines to `take`, and counts those that it says it took.
template <class Take>
void read_lines(const std::filesystem::path& path, const InputReading& reading, InputAccount& account,
                Take take) {
  io::JsonLinesReader in(path);
  while (const auto record = in.next_frame(account.left_out)) {
    reading.on_step(in.progress());
    account.count += take(*record) ? 1U : 0U;
  }
}

/// Visits all messages of type T, which are `member` of frames in JSON lines.
template <class T>
InputAccount for_each_other(const std::filesystem::path& path, const Visit<T>& visit,
                            const InputReading& reading, std::optional<T> io::FrameRecord::*member) {
  InputAccount account{.left_out = LeftOut(reading.strict)};
  if (recording::is_recording(path)) {
    RecordedOthers<T> others(visit);
    read_recorded<T>(path, reading, others, account);
    others.visit_ready();
    return account;
  }
  std::int64_t last_stamp_ns = 0;
  read_lines(path, reading, account, [&](const io::FrameRecord& record) {
    const std::optional<T>& message = record.*member;
    if (!message) return false;
    if (message->stamp_ns > last_stamp_ns) visit(*message, transform(record.pose));
    last_stamp_ns = std::max(last_stamp_ns, message->stamp_ns);
    return true;
  });
  return account;
}

}  // namespace

InputAccount for_each_frame(const std::filesystem::path& path, const VisitFrame& visit,
                            const InputReading& reading) {
  InputAccount account{.left_out = LeftOut(reading.strict)};
  if (recording::is_recording(path)) {
    RecordedFrames frames(visit, account.left_out);
    read_recorded<DetectionFrame>(path, reading, frames, account);
    return account;
  }
  Ascending ascending(visit, account.left_out);
  read_lines(path, reading, account, [&](const io::FrameRecord& record) {
    ascending(record.frame, transform(record.pose));
    return true;
  });
  return account;
}

InputAccount for_each_objects(const std::filesystem::path& path, const Visit<TrackedObjects>& visit,
                              const InputReading& reading) {
  return for_each_other(path, visit, reading, &io::FrameRecord::objects);
}

InputAccount for_each_next_turn(const std::filesystem::path& path, const Visit<NextTurn>& visit,
                                const InputReading& reading) {
  return for_each_other(path, visit, reading, &io::FrameRecord::next_turn);
}

InputAccount for_each_map(const std::filesystem::path& path, const VisitMap& visit,
                          const InputReading& reading) {
  InputAccount account{.left_out = LeftOut(reading.strict)};
  NewestMaps maps(visit, account.left_out);
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
