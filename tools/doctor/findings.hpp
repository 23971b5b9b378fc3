#pragma once

#include <optional>
#include <string>
#include <vector>

#include "doctor/observed.hpp"

/// Findings on why messages do not arrive. Pure functions, one per subject.
namespace laneloom::doctor {

/// A reason why messages do not arrive or arrive badly, with its remedy; or an advice.
struct Finding {
  std::string id;       ///< for machines
  std::string found;    ///< the fact
  std::string why;      ///< why the fact matters
  std::string remedy;   ///< what to do
  bool advice = false;  ///< nothing is wrong, but something could be better
};
using Findings = std::vector<Finding>;

/// Finds a process of the service on this host that is stopped. None: there is no such process.
std::optional<Finding> stopped_service(const Observed& seen);
/// Finds that nobody is in the domain, or not exactly one service of the vehicle.
Findings presence_findings(const Observed& seen);
/// Finds writers and readers whose name, type or partition differs from the service's, and inputs that nobody
/// writes.
Findings topic_findings(const Observed& seen);
/// Finds nodes of ROS 2 that write detections or odometry where the service does not read them.
Findings ros_findings(const Observed& seen);
/// Finds writers and readers of the vehicle that do not match only because of their quality of service.
Findings qos_findings(const Observed& seen);
/// Finds inputs that do not come, come too seldom, have stamps of another clock, or do not come whole.
Findings stream_findings(const Observed& seen);
/// Finds sources of detections that do not write as one source should, and too many sources.
Findings source_findings(const Observed& seen);
/// Finds messages that the service refuses, and other counters that should not rise.
Findings incident_findings(const Observed& seen);
/// Finds states that the service reports of itself, which are consequences.
Findings state_findings(const Observed& seen);
/// Finds obstacles to shared memory, if that is used.
Findings shared_memory_findings(const Observed& seen);

/// Finds conventions by which detections and poses would fit together better, as `laneloom check` does of a
/// recording. An offset to a side is left out: on a short drive it is the driver's.
Findings fit_findings(const Observed& seen, const MapperConfig& mapper);

/// All of these findings but the last, each once, in this order, so that causes stand before their
/// consequences. If nobody is in the domain, findings on what these participants lack are left out.
Findings findings(const Observed& seen);

}  // namespace laneloom::doctor
