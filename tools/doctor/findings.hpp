#pragma once

#include <string>
#include <vector>

#include "doctor/observed.hpp"

/// Why nothing arrives. Pure functions, one per subject.
namespace laneloom {

struct Finding {
  std::string id;       ///< for machines
  std::string found;    ///< what is so
  std::string why;      ///< why that matters
  std::string remedy;   ///< what to do
  bool advice = false;  ///< nothing is wrong, but it could be better
};
using Findings = std::vector<Finding>;

/// Whether anybody is in the domain, and the one service of the vehicle is.
Findings presence_findings(const Observed& seen);
/// Who writes or reads under another name, type or partition than the service, and what nobody writes.
Findings topic_findings(const Observed& seen);
/// Nodes of ROS 2 that write detections or odometry where the service does not read them.
Findings ros_findings(const Observed& seen);
/// Which writers and readers of the vehicle would match, but for their quality of service.
Findings qos_findings(const Observed& seen);
/// Whether the inputs come, how often, by which clocks, and whole.
Findings stream_findings(const Observed& seen);
/// Whether each source of detections writes as one source should, and how many there are.
Findings source_findings(const Observed& seen);
/// What the service refuses, and what else it counts that should not happen.
Findings incident_findings(const Observed& seen);
/// What the service says of itself: the consequences.
Findings state_findings(const Observed& seen);
/// What is in the way of shared memory, where that is used.
Findings shared_memory_findings(const Observed& seen);

/// All of these, in this order, so that causes stand before their consequences; each once. Where nobody is
/// there, no more is said of those who are not.
Findings findings(const Observed& seen);

}  // namespace laneloom
