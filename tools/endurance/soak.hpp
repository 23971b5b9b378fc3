#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "endurance/account.hpp"
#include "endurance/fleet.hpp"
#include "endurance/watch.hpp"

namespace laneloom {

struct SoakSpec {
  Fleet::Spec fleet;
  std::chrono::duration<double> duration{60};
  std::uint64_t seed = 1;             ///< of the faults
  std::chrono::seconds patience{30};  ///< until good maps follow a fault
  /// Within this time of a fault's end, the planner must have a map to drive on, of what is seen then.
  std::chrono::duration<double> recovery{5};
};

struct FaultCount {
  int times = 0;
  double longest_recovery_s = 0.0;  ///< of the planner
};

struct SoakResult {
  std::map<std::uint64_t, Account> accounts;  ///< by session of the service
  Watch::Maps maps;
  std::map<std::string, FaultCount> faults;
  std::vector<std::string> failures;  ///< what did not recover from a fault, or ended by itself or badly

  bool passed() const;
};

/// Runs a fleet for so long, with one random fault after another; every fault ends, a good map must
/// follow, at the planner in time, no process may end by itself, and one that is told to end must, in good
/// order. `go_on` is asked between faults. Throws std::runtime_error where the fleet cannot be started or no
/// map comes.
SoakResult soak(const SoakSpec& spec, const std::function<bool()>& go_on);

}  // namespace laneloom
