#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <variant>

#include "laneloom/dds/topics.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "recording/recording.hpp"

/// The topics of laneloom as a recording describes them.
namespace laneloom::recording {

/// The IDL of a message as one text: included files are inserted, and there is no line for a preprocessor,
/// which readers of recordings do not have. Made from idl/ by flatten_idl.cmake.
extern const char* const kDetectionsIdl;
extern const char* const kVehiclePoseIdl;
extern const char* const kObjectsIdl;
extern const char* const kNextTurnIdl;
extern const char* const kLaneMapIdl;
extern const char* const kRoadMarkingsIdl;
extern const char* const kServiceStatusIdl;

/// The names of the topics, in the order of AnyMessage.
inline constexpr std::array<const char*, std::variant_size_v<AnyMessage>> kTopicNames{
    dds::kDetectionsTopic, dds::kVehiclePoseTopic, dds::kLaneMapTopic, dds::kRoadMarkingsTopic,
    dds::kStatusTopic,     dds::kObjectsTopic,     dds::kNextTurnTopic};

/// The index of T among the types of a variant.
template <class T, class... All>
constexpr std::size_t index_among(const std::variant<All...>* /*type*/) {
  std::size_t index = 0;
  static_cast<void>(((std::is_same_v<T, All> || (++index, false)) || ...));
  return index;
}

/// The index of T's topic in kTopicNames and in AnyMessage.
template <class T>
inline constexpr std::size_t kTopicIndex = index_among<T>(static_cast<const AnyMessage*>(nullptr));

inline constexpr const char* kCdr = "cdr";
inline constexpr const char* kOmgIdl = "omgidl";

/// A topic with its message type and the IDL of that type.
struct RecordedTopic {
  const char* name;
  const char* type;
  const char* idl;
  std::string_view name_in_v2 =
      {};  ///< in version 2 of the topics, if its type was the same; empty: it was not

  bool is_called(std::string_view topic) const {
    return topic == name || (!name_in_v2.empty() && topic == name_in_v2);
  }
};

/// The metadata of a recording, and its keys: see Origin.
///@{
inline constexpr const char* kOriginName = "laneloom";
inline constexpr const char* kVersionKey = "version";
inline constexpr const char* kConfigurationKey = "configuration";
///@}

template <class T>
RecordedTopic topic_of();
template <>
inline RecordedTopic topic_of<DetectionFrame>() {
  return {dds::kDetectionsTopic, dds::kDetectionsType, kDetectionsIdl, "laneloom/v2/detections"};
}
template <>
inline RecordedTopic topic_of<VehiclePose>() {
  return {dds::kVehiclePoseTopic, dds::kVehiclePoseType, kVehiclePoseIdl, "laneloom/v2/vehicle_pose"};
}
template <>
inline RecordedTopic topic_of<TrackedObjects>() {
  return {dds::kObjectsTopic, dds::kObjectsType, kObjectsIdl};
}
template <>
inline RecordedTopic topic_of<NextTurn>() {
  return {dds::kNextTurnTopic, dds::kNextTurnType, kNextTurnIdl};
}
template <>
inline RecordedTopic topic_of<PublishedMap>() {
  return {dds::kLaneMapTopic, dds::kLaneMapType, kLaneMapIdl};
}
template <>
inline RecordedTopic topic_of<RoadMarkings>() {
  return {dds::kRoadMarkingsTopic, dds::kRoadMarkingsType, kRoadMarkingsIdl};
}
template <>
inline RecordedTopic topic_of<ServiceStatus>() {
  return {dds::kStatusTopic, dds::kStatusType, kServiceStatusIdl};
}

}  // namespace laneloom::recording
