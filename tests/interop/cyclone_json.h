#pragma once

#include "Detections.h"
#include "LaneMap.h"
#include "RoadMarkings.h"
#include "ServiceStatus.h"
#include "VehiclePose.h"

// A message as one line on standard output: {"topic": …, "message": …}, field by field in the form of
// tests/recording/message_json.hpp: numbers of 64 bits are texts.
void print_detections(const laneloom_msg_Detections* message);
void print_vehicle_pose(const laneloom_msg_VehiclePose* message);
void print_lane_map(const laneloom_msg_LaneMap* message);
void print_road_markings(const laneloom_msg_RoadMarkings* message);
void print_status(const laneloom_msg_ServiceStatus* message);
