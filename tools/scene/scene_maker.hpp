#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "laneloom/messages.hpp"
#include "laneloom/objects.hpp"
#include "recording/recording.hpp"
#include "scene/foxglove.hpp"
#include "session/pose_buffer.hpp"

namespace laneloom::scene {

enum class SceneTopic : std::uint8_t { map, detections, objects, ids, transforms };

/// The topics that a recording or a server has to announce, in the order of SceneTopic.
const std::vector<recording::ExtraTopic>& scene_topics();

/// A message of a scene topic, as CDR.
struct SceneMessage {
  SceneTopic topic = SceneTopic::map;
  std::vector<std::uint8_t> bytes;
};

/// The updates of one topic. Each is complete, so that a panel may begin with any of them. Entities that are
/// no longer in an update are deleted by it. Not thread-safe.
class SceneStream {
 public:
  foxglove::SceneUpdate update(std::vector<foxglove::SceneEntity> entities, std::int64_t time_ns);

 private:
  std::set<std::string> ids_;
};

/// Makes scenes from the messages of a vehicle. Times in them are log times, because panels play by these;
/// stamps may be of another clock. Not thread-safe.
class SceneMaker {
 public:
  /// `map_frame_id`: the frame that poses are in.
  explicit SceneMaker(std::string map_frame_id) : map_frame_id_(std::move(map_frame_id)) {}

  /// Takes a message, in the order of log times, and returns the scenes that it changes. A message that is
  /// refused, or of which nothing is drawn, changes none. Detections and objects are drawn when the pose at
  /// their stamp is known.
  std::vector<SceneMessage> take(const recording::RawMessage& message);
  /// Does the same with a message that was not refused.
  std::vector<SceneMessage> take(const recording::AnyMessage& message, std::int64_t log_time_ns);

 private:
  /// The scene of messages that wait for the pose at their stamp.
  template <class T>
  struct Located {
    SceneTopic topic;
    SceneStream scene = {};
    std::deque<T> waiting = {};
  };

  template <class T>
  void take_as(const recording::RawMessage& message, std::vector<SceneMessage>& to);
  void draw(const PublishedMap& published, std::int64_t time_ns, std::vector<SceneMessage>& to);
  void draw(const VehiclePose& pose, std::int64_t time_ns, std::vector<SceneMessage>& to);
  void draw(const DetectionFrame& frame, std::int64_t time_ns, std::vector<SceneMessage>& to);
  void draw(const TrackedObjects& objects, std::int64_t time_ns, std::vector<SceneMessage>& to);
  template <class T>
  void wait_in(Located<T>& located, const T& message, std::int64_t time_ns, std::vector<SceneMessage>& to);
  template <class T>
  void draw_waiting(Located<T>& located, std::int64_t time_ns, std::vector<SceneMessage>& to);

  std::string map_frame_id_;
  SceneStream map_, ids_;
  session::PoseBuffer poses_{SyncConfig{}};
  std::uint64_t pose_session_ = 0;
  std::int64_t newest_pose_ns_ = 0;
  Located<DetectionFrame> detections_{SceneTopic::detections};
  Located<TrackedObjects> objects_{SceneTopic::objects};
};

}  // namespace laneloom::scene
