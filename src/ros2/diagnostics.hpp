#pragma once

#include <string>

#include "DiagnosticMsgs.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::ros2 {

/// The service's status for a diagnostic aggregator: one entry, whose level is the state of the map (OK, WARN
/// for DEGRADED, STALE), and whose values are ages, times and counters. `node` is the node's full name,
/// `vehicle_id` the hardware's.
diagnostic_msgs::msg::dds_::DiagnosticArray_ to_diagnostics(const ServiceStatus& status,
                                                            const std::string& node,
                                                            const std::string& vehicle_id);

}  // namespace laneloom::ros2
