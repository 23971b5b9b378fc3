#pragma once

#include "DetectionsPubSubTypes.h"
#include "LaneMapPubSubTypes.h"
#include "RoadMarkingsPubSubTypes.h"
#include "ServiceStatusPubSubTypes.h"
#include "VehiclePosePubSubTypes.h"
#include "cdr/message_of.hpp"
#include "dds/checked_type.hpp"
#include "dds/qos.hpp"
#include "laneloom/dds/topics.hpp"

/// The topic of each plain type.
namespace laneloom::dds {

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

}  // namespace laneloom::dds
