#pragma once

#include <memory>

#include "dds/topic_writer.hpp"
#include "laneloom/config.hpp"

namespace laneloom::ros2 {

/// Announces to ROS that the participant's writers and readers belong to a node, which `ros2 node list` then
/// shows. Returns the writer that keeps the announcement for nodes that come later. Endpoints that the
/// participant gets later are not announced. Throws as dds::Participant().
std::unique_ptr<dds::TopicWriter> announce(const std::shared_ptr<dds::Participant::Impl>& participant,
                                           const Ros2Config& config);

}  // namespace laneloom::ros2
