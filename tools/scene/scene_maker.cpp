#include "scene/scene_maker.hpp"

#include <utility>

#include "drawing/frame_elements.hpp"
#include "drawing/map_elements.hpp"
#include "drawing/traffic_elements.hpp"
#include "laneloom/dds/cdr.hpp"
#include "recording/topics.hpp"
#include "scene/scene_entities.hpp"

namespace laneloom::scene {
namespace {

constexpr const char* kBodyFrame = "body";
/// A scene that is not updated disappears after this time, so that it is not taken for a live one.
constexpr double kLifetime_s = 2.0;
constexpr std::size_t kMaxWaiting = 32;

SceneMessage message_of(SceneTopic topic, const foxglove::SceneUpdate& update) {
  return {topic, foxglove::to_cdr(update)};
}

drawing::Drawing ids_of(const LocalMap& map) {
  drawing::Drawing drawing;
  drawing.T_map_body = map.T_map_body;
  add_ids(map, drawing);
  return drawing;
}

void add_seen(const DetectionFrame& frame, drawing::Drawing& drawing) {
  add_detections(frame, drawing.T_map_body, drawing);
  add_view(frame, drawing.T_map_body, drawing);
}

void add_seen(const TrackedObjects& objects, drawing::Drawing& drawing) {
  add_objects(in_body_frame(objects, drawing.T_map_body), drawing.T_map_body, drawing);
}

}  // namespace

const std::vector<recording::ExtraTopic>& scene_topics() {
  using foxglove::kFrameTransformType, foxglove::kIdl, foxglove::kSceneUpdateType;
  static const std::vector<recording::ExtraTopic> topics{
      {"/laneloom/scene", foxglove::kSceneUpdateType, foxglove::kIdl},
      {"/laneloom/scene/detections", foxglove::kSceneUpdateType, foxglove::kIdl},
      {"/laneloom/scene/objects", foxglove::kSceneUpdateType, foxglove::kIdl},
      {"/laneloom/scene/ids", foxglove::kSceneUpdateType, foxglove::kIdl},
      {"/tf", foxglove::kFrameTransformType, foxglove::kIdl}};
  return topics;
}

foxglove::SceneUpdate SceneStream::update(std::vector<foxglove::SceneEntity> entities, std::int64_t time_ns) {
  std::set<std::string> ids;
  for (const foxglove::SceneEntity& entity : entities) ids.insert(entity.id);
  foxglove::SceneUpdate update{time_ns, kLifetime_s, {}, std::move(entities)};
  for (const std::string& id : ids_)
    if (!ids.contains(id)) update.deleted.push_back(id);
  ids_ = std::move(ids);
  return update;
}

std::vector<SceneMessage> SceneMaker::take(const recording::RawMessage& message) {
  std::vector<SceneMessage> out;
  if (message.topic == recording::kTopicIndex<PublishedMap>) take_as<PublishedMap>(message, out);
  if (message.topic == recording::kTopicIndex<VehiclePose>) take_as<VehiclePose>(message, out);
  if (message.topic == recording::kTopicIndex<DetectionFrame>) take_as<DetectionFrame>(message, out);
  if (message.topic == recording::kTopicIndex<TrackedObjects>) take_as<TrackedObjects>(message, out);
  return out;
}

std::vector<SceneMessage> SceneMaker::take(const recording::AnyMessage& message, std::int64_t log_time_ns) {
  std::vector<SceneMessage> out;
  if (const auto* map = std::get_if<PublishedMap>(&message)) draw(*map, log_time_ns, out);
  if (const auto* pose = std::get_if<VehiclePose>(&message)) draw(*pose, log_time_ns, out);
  if (const auto* frame = std::get_if<DetectionFrame>(&message)) draw(*frame, log_time_ns, out);
  if (const auto* objects = std::get_if<TrackedObjects>(&message)) draw(*objects, log_time_ns, out);
  return out;
}

template <class T>
void SceneMaker::take_as(const recording::RawMessage& message, std::vector<SceneMessage>& to) {
  T taken;
  if (dds::from_cdr(message.bytes, map_frame_id_, taken).empty()) draw(taken, message.log_time_ns, to);
}

void SceneMaker::draw(const PublishedMap& published, std::int64_t time_ns, std::vector<SceneMessage>& to) {
  drawing::Drawing map, vehicle;
  add_map(published.map, map);
  add_uncertainty(published.map, map);
  add_vehicle(Eigen::Isometry3d::Identity(), vehicle);
  std::vector<foxglove::SceneEntity> entities, ids;
  append_entities(map, {published.frame_id}, entities);
  append_entities(vehicle, {kBodyFrame, true}, entities);
  append_entities(ids_of(published.map), {published.frame_id}, ids);
  to.push_back(message_of(SceneTopic::map, map_.update(std::move(entities), time_ns)));
  to.push_back(message_of(SceneTopic::ids, ids_.update(std::move(ids), time_ns)));
}

void SceneMaker::draw(const VehiclePose& pose, std::int64_t time_ns, std::vector<SceneMessage>& to) {
  const bool begins_anew = pose.session_id != std::exchange(pose_session_, pose.session_id);
  if (begins_anew) poses_.clear();
  if (!begins_anew && pose.stamp_ns <= newest_pose_ns_) return;  // the service refuses it, too
  newest_pose_ns_ = pose.stamp_ns;
  poses_.add(pose);
  to.push_back({SceneTopic::transforms, foxglove::to_cdr(foxglove::FrameTransform{
                                            time_ns, map_frame_id_, kBodyFrame, transform(pose)})});
  draw_waiting(detections_, time_ns, to);
  draw_waiting(objects_, time_ns, to);
}

void SceneMaker::draw(const DetectionFrame& frame, std::int64_t time_ns, std::vector<SceneMessage>& to) {
  wait_in(detections_, frame, time_ns, to);
}

void SceneMaker::draw(const TrackedObjects& objects, std::int64_t time_ns, std::vector<SceneMessage>& to) {
  wait_in(objects_, objects, time_ns, to);
}

template <class T>
void SceneMaker::wait_in(Located<T>& located, const T& message, std::int64_t time_ns,
                         std::vector<SceneMessage>& to) {
  located.waiting.push_back(message);
  if (located.waiting.size() > kMaxWaiting) located.waiting.pop_front();
  draw_waiting(located, time_ns, to);
}

template <class T>
void SceneMaker::draw_waiting(Located<T>& located, std::int64_t time_ns, std::vector<SceneMessage>& to) {
  for (; !located.waiting.empty(); located.waiting.pop_front()) {
    drawing::Drawing drawing;
    const session::PoseBuffer::Answer answer =
        poses_.at(located.waiting.front().stamp_ns, drawing.T_map_body);
    if (answer == session::PoseBuffer::Answer::not_yet) return;
    if (answer == session::PoseBuffer::Answer::never) continue;
    add_seen(located.waiting.front(), drawing);
    std::vector<foxglove::SceneEntity> entities;
    append_entities(drawing, {map_frame_id_}, entities);
    to.push_back(message_of(located.topic, located.scene.update(std::move(entities), time_ns)));
  }
}

}  // namespace laneloom::scene
