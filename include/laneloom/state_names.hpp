#pragma once

#include <string>
#include <vector>

#include "laneloom/messages.hpp"

/// Words for the states of a map, for people to read in logs and in the planner's view.
namespace laneloom {

/// The name of the enumerator, in upper case.
inline const char* name(MapState state) {
  switch (state) {
    case MapState::ok:
      return "OK";
    case MapState::degraded:
      return "DEGRADED";
    case MapState::stale:
      return "STALE";
  }
  return "unknown";
}

/// The name of the enumerator.
inline const char* name(StateReason reason) {
  switch (reason) {
    case StateReason::no_detections:
      return "no_detections";
    case StateReason::no_poses:
      return "no_poses";
    case StateReason::unsynchronised:
      return "unsynchronised";
    case StateReason::starting:
      return "starting";
    case StateReason::reset:
      return "reset";
    case StateReason::overloaded:
      return "overloaded";
    case StateReason::another_service:
      return "another_service";
    case StateReason::outdated:
      return "outdated";
    case StateReason::source_not_fused:
      return "source_not_fused";
    case StateReason::sources_disagree:
      return "sources_disagree";
    case StateReason::poses_jumped:
      return "poses_jumped";
    case StateReason::driving_side_contradicted:
      return "driving_side_contradicted";
  }
  return "unknown";
}

/// State and reasons in one line, such as "DEGRADED no_poses reset".
inline std::string state_text(MapState state, const std::vector<StateReason>& reasons) {
  std::string text = name(state);
  for (const StateReason reason : reasons) text += std::string(" ") + name(reason);
  return text;
}

}  // namespace laneloom
