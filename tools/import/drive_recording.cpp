#include "import/drive_recording.hpp"

#include <limits>
#include <span>

#include "io/leave_out.hpp"
#include "io/new_file.hpp"
#include "recording/recording.hpp"
#include "session/pose_buffer.hpp"

namespace laneloom::imports {
namespace {

constexpr std::uint64_t kSession = 1;

/// Writes messages of one topic, counted, and tells what of them is left out.
template <class T>
class Stream {
 public:
  Stream(recording::RecordingWriter& out, LeftOut& left_out) : out_(out), left_out_(left_out) {}
  void write(T message) {
    if (message.session_id == 0) message.session_id = kSession;
    message.sequence = ++sequence_;
    const std::uint64_t before = out_.left_out();
    out_.write(message, message.stamp_ns);
    if (const std::uint64_t more = out_.left_out() - before; more > 0)
      io::leave_out(left_out_, io::kBeyondBounds, message.stamp_ns, more);
  }

  /// Writes the messages from `next` on that are not newer.
  void write_until(std::int64_t stamp_ns, std::span<const T>& next) {
    for (; !next.empty() && next.front().stamp_ns <= stamp_ns; next = next.subspan(1)) write(next.front());
  }

 private:
  recording::RecordingWriter& out_;
  LeftOut& left_out_;
  std::uint64_t sequence_ = 0;
};

void write_messages(recording::RecordingWriter& out, const std::vector<VehiclePose>& poses,
                    const std::vector<DetectionFrame>& frames, const OtherInputs& others, LeftOut& left_out) {
  Stream<VehiclePose> pose_stream(out, left_out);
  Stream<DetectionFrame> frame_stream(out, left_out);
  Stream<TrackedObjects> objects_stream(out, left_out);
  Stream<NextTurn> turns_stream(out, left_out);
  std::span<const TrackedObjects> objects(others.objects);
  std::span<const NextTurn> turns(others.next_turns);
  const auto write_others_until = [&](std::int64_t stamp_ns) {
    objects_stream.write_until(stamp_ns, objects);
    turns_stream.write_until(stamp_ns, turns);
  };
  auto frame = frames.begin();
  const auto write_before = [&](std::int64_t stamp_ns) {
    for (; frame != frames.end() && frame->stamp_ns < stamp_ns; ++frame) {
      write_others_until(frame->stamp_ns);
      frame_stream.write(*frame);
    }
    write_others_until(stamp_ns - 1);
  };
  for (const VehiclePose& pose : poses) {
    write_before(pose.stamp_ns);
    pose_stream.write(pose);
  }
  write_before(std::numeric_limits<std::int64_t>::max());
  out.close();
}

}  // namespace

std::size_t drop_frames_without_pose(std::vector<DetectionFrame>& frames,
                                     const std::vector<VehiclePose>& poses) {
  SyncConfig config;
  config.pose_history_s = std::numeric_limits<double>::infinity();
  config.pose_queue_capacity = std::numeric_limits<int>::max();
  session::PoseBuffer buffer(config);
  for (const VehiclePose& pose : poses) buffer.add(pose);
  return std::erase_if(frames, [&](const DetectionFrame& frame) {
    Eigen::Isometry3d T_map_body;
    return buffer.at(frame.stamp_ns, T_map_body) != session::PoseBuffer::Answer::found;
  });
}

LeftOut write_drive(const std::string& path, const std::vector<VehiclePose>& poses,
                    const std::vector<DetectionFrame>& frames, const OtherInputs& others, bool strict) {
  LeftOut left_out(strict);
  io::make_file(path, [&] {
    recording::RecordingWriter out(path);
    write_messages(out, poses, frames, others, left_out);
  });
  return left_out;
}

}  // namespace laneloom::imports
