#pragma once

#include <memory>
#include <string>

#include "dds/participant_impl.hpp"
#include "ros2/input.hpp"
#include "ros2/listener.hpp"

namespace laneloom::ros2 {

/// A participant among nodes of ROS 2, which are in no partition.
std::shared_ptr<dds::Participant::Impl> make_participant(DdsConfig dds, const std::string& name,
                                                         dds::Participant::Presence presence);

/// The readers of all inputs.
class InputReaders {
 public:
  InputReaders(const std::shared_ptr<dds::Participant::Impl>& participant, const Config& config,
               Inputs inputs);

 private:
  Input<msg::Detections, DetectionFrame> detections_;
  Input<nav_msgs::msg::dds_::Odometry_, VehiclePose> odometry_;
  Input<autoware_perception_msgs::msg::dds_::TrackedObjects_, TrackedObjects> objects_;
  Input<msg::NextTurn, NextTurn> next_turns_;
};

}  // namespace laneloom::ros2
