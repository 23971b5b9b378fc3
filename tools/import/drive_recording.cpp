#include "import/drive_recording.hpp"

#include <limits>
#include <stdexcept>

#include "recording/recording.hpp"
#include "session/pose_buffer.hpp"

namespace laneloom::imports {
namespace {

constexpr std::uint64_t kSession = 1;

/// Writes messages of one topic, counted.
template <class T>
class Stream {
 public:
  explicit Stream(recording::RecordingWriter& out) : out_(out) {}
  void write(T message) {
    message.session_id = kSession;
    message.sequence = ++sequence_;
    out_.write(message, message.stamp_ns);
  }

 private:
  recording::RecordingWriter& out_;
  std::uint64_t sequence_ = 0;
};

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

void write_drive(const std::string& path, const std::vector<VehiclePose>& poses,
                 const std::vector<DetectionFrame>& frames, const std::vector<TrackedObjects>& objects) {
  recording::RecordingWriter out(path);
  Stream<VehiclePose> pose_stream(out);
  Stream<DetectionFrame> frame_stream(out);
  Stream<TrackedObjects> objects_stream(out);
  auto next = objects.begin();
  const auto write_objects_until = [&](std::int64_t stamp_ns) {
    for (; next != objects.end() && next->stamp_ns <= stamp_ns; ++next) objects_stream.write(*next);
  };
  auto frame = frames.begin();
  const auto write_before = [&](std::int64_t stamp_ns) {
    for (; frame != frames.end() && frame->stamp_ns < stamp_ns; ++frame) {
      write_objects_until(frame->stamp_ns);
      frame_stream.write(*frame);
    }
    write_objects_until(stamp_ns - 1);
  };
  for (const VehiclePose& pose : poses) {
    write_before(pose.stamp_ns);
    pose_stream.write(pose);
  }
  write_before(std::numeric_limits<std::int64_t>::max());
  out.close();
  if (out.left_out() > 0)
    throw std::runtime_error(out.path() + ": " + std::to_string(out.left_out()) +
                             " elements exceed the bounds of a message");
}

}  // namespace laneloom::imports
