#include "ros2/input_readers.hpp"

#include <string_view>
#include <type_traits>
#include <utility>

#include "cdr/convert.hpp"
#include "ros2/topic.hpp"

namespace laneloom::ros2 {
namespace {

using autoware_perception_msgs::msg::dds_::TrackedObjects_;
using dds::TopicKind;
using nav_msgs::msg::dds_::Odometry_;

/// Converts as `convert` does, which takes messages of one map frame. `From` is a message as it takes them.
template <class From, class T>
typename Input<std::remove_cvref_t<From>, T>::Convert in_frame_of(
    const Config& config, std::string_view (*convert)(From, const std::string&, T&)) {
  return [convert, frame = config.dds.map_frame_id](std::remove_cvref_t<From>&& from, T& to) {
    return convert(std::move(from), frame, to);
  };
}

}  // namespace

std::shared_ptr<dds::Participant::Impl> make_participant(DdsConfig dds, const std::string& name,
                                                         dds::Participant::Presence presence) {
  dds.vehicle_id.clear();
  return std::make_shared<dds::Participant::Impl>(dds, name, presence, kParticipantUserData);
}

InputReaders::InputReaders(const std::shared_ptr<dds::Participant::Impl>& participant, const Config& config,
                           Inputs inputs)
    : detections_(participant,
                  topic<dds::CheckedType<msg::DetectionsPubSubType>>(config.ros2, kDetectionsTopic,
                                                                     kDetectionsType, TopicKind::detections),
                  std::move(inputs.detections),
                  in_frame_of<msg::Detections&&, DetectionFrame>(config, dds::from_msg)),
      odometry_(participant,
                topic<OdometryType>(config.ros2, config.ros2.odometry_topic, kOdometryType, TopicKind::poses),
                std::move(inputs.poses), in_frame_of<const Odometry_&, VehiclePose>(config, from_ros)),
      objects_(
          participant,
          topic<ObjectsType>(config.ros2, config.ros2.objects_topic, kObjectsType, TopicKind::optional_input),
          std::move(inputs.objects), in_frame_of<const TrackedObjects_&, TrackedObjects>(config, from_ros)),
      next_turns_(participant,
                  topic<dds::CheckedType<msg::NextTurnPubSubType>>(config.ros2, kNextTurnTopic, kNextTurnType,
                                                                   TopicKind::optional_input),
                  std::move(inputs.next_turns),
                  in_frame_of<const msg::NextTurn&, NextTurn>(config, dds::from_msg)) {}

}  // namespace laneloom::ros2
