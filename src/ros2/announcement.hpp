#pragma once

#include <memory>

#include "dds/topic_writer.hpp"
#include "laneloom/config.hpp"

namespace laneloom::ros2 {

/// Tells ROS that what the participant writes and reads is of a node, as `ros2 node list` shows. Returns the
/// writer that keeps the announcement for those who come later. Of what the participant gets later, nothing
/// is told. Throws as dds::Participant().
std::unique_ptr<dds::TopicWriter> announce(const std::shared_ptr<dds::Participant::Impl>& participant,
                                           const Ros2Config& config);

}  // namespace laneloom::ros2
