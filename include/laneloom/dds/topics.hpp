#pragma once

/// The topics of laneloom. Types cannot evolve in place: a change of any type is a new version here.
namespace laneloom::dds {

inline constexpr const char* kDetectionsTopic = "laneloom/v3/detections";
inline constexpr const char* kVehiclePoseTopic = "laneloom/v3/vehicle_pose";
inline constexpr const char* kObjectsTopic = "laneloom/v3/objects";
inline constexpr const char* kNextTurnTopic = "laneloom/v3/next_turn";
inline constexpr const char* kLaneMapTopic = "laneloom/v3/lane_map";
inline constexpr const char* kRoadMarkingsTopic = "laneloom/v3/road_markings";
inline constexpr const char* kStatusTopic = "laneloom/v3/status";

/// The types of the topics, by the names that go over the wire.
inline constexpr const char* kDetectionsType = "laneloom::msg::Detections";
inline constexpr const char* kVehiclePoseType = "laneloom::msg::VehiclePose";
inline constexpr const char* kObjectsType = "laneloom::msg::Objects";
inline constexpr const char* kNextTurnType = "laneloom::msg::NextTurn";
inline constexpr const char* kLaneMapType = "laneloom::msg::LaneMap";
inline constexpr const char* kRoadMarkingsType = "laneloom::msg::RoadMarkings";
inline constexpr const char* kStatusType = "laneloom::msg::ServiceStatus";

}  // namespace laneloom::dds
