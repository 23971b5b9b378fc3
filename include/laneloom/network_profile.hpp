#pragma once

#include <map>
#include <string>

namespace laneloom {

/// A mean that was learned. `weight` new values count as much as it does.
struct LearnedValue {
  double value = 0.0, weight = 0.0;

  /// Whether value and weight are the same.
  bool operator==(const LearnedValue&) const = default;
};

/// A profile holds what was learned of one network, by name. `src/mapping/README.md` explains each value.
using NetworkProfile = std::map<std::string, LearnedValue>;

/// Profiles by the source that the network's frames name.
using NetworkProfiles = std::map<std::string, NetworkProfile>;

}  // namespace laneloom
