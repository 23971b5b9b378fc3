#pragma once

#include <fastdds/dds/topic/TypeSupport.hpp>

#include <string>

#include "DetectionsPubSubTypes.hpp"
#include "LaneMapPubSubTypes.hpp"
#include "NextTurnPubSubTypes.hpp"
#include "ObjectsPubSubTypes.hpp"
#include "RoadMarkingsPubSubTypes.hpp"
#include "ServiceStatusPubSubTypes.hpp"
#include "VehiclePosePubSubTypes.hpp"
#include "cdr/message_of.hpp"
#include "dds/checked_type.hpp"
#include "dds/qos.hpp"
#include "laneloom/dds/topics.hpp"

namespace laneloom::dds {

/// The properties of a topic that its readers and writers need.
struct TopicDescription {
  std::string name;
  TopicKind kind;
  eprosima::fastdds::dds::TypeSupport type;
  std::string user_data;  ///< announced with the endpoint; ROS 2 puts the hash of the type there
};

/// The topic of each plain type.
template <class T>
struct TopicTraits;

template <>
struct TopicTraits<DetectionFrame> {
  using Type = CheckedType<msg::DetectionsPubSubType>;
  static constexpr auto kName = kDetectionsTopic;
  static constexpr auto kKind = TopicKind::detections;
};

template <>
struct TopicTraits<VehiclePose> {
  using Type = CheckedType<msg::VehiclePosePubSubType>;
  static constexpr auto kName = kVehiclePoseTopic;
  static constexpr auto kKind = TopicKind::poses;
};

template <>
struct TopicTraits<TrackedObjects> {
  using Type = CheckedType<msg::ObjectsPubSubType>;
  static constexpr auto kName = kObjectsTopic;
  static constexpr auto kKind = TopicKind::optional_input;
};

template <>
struct TopicTraits<NextTurn> {
  using Type = CheckedType<msg::NextTurnPubSubType>;
  static constexpr auto kName = kNextTurnTopic;
  static constexpr auto kKind = TopicKind::optional_input;
};

template <>
struct TopicTraits<PublishedMap> {
  using Type = CheckedType<msg::LaneMapPubSubType>;
  static constexpr auto kName = kLaneMapTopic;
  static constexpr auto kKind = TopicKind::map;
};

template <>
struct TopicTraits<RoadMarkings> {
  using Type = CheckedType<msg::RoadMarkingsPubSubType>;
  static constexpr auto kName = kRoadMarkingsTopic;
  static constexpr auto kKind = TopicKind::map;
};

template <>
struct TopicTraits<ServiceStatus> {
  using Type = CheckedType<msg::ServiceStatusPubSubType>;
  static constexpr auto kName = kStatusTopic;
  static constexpr auto kKind = TopicKind::status;
};

/// The topic of T, with `Type` as the type support of its samples.
template <class T, class Type>
TopicDescription topic_of() {
  return {TopicTraits<T>::kName, TopicTraits<T>::kKind, eprosima::fastdds::dds::TypeSupport(new Type), {}};
}

}  // namespace laneloom::dds
