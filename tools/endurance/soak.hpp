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

namespace laneloom::endurance {

/// The fleet of a soak test, its duration and the limits for recovery.
struct SoakSpec {
  Fleet::Spec fleet;
  std::chrono::duration<double> duration{60};
  std::uint64_t seed = 1;             ///< of the faults
  std::chrono::seconds patience{30};  ///< longest wait for a good map after a fault
  /// The planner must have a map to drive on, with a frame from after the fault, within this time of the
  /// fault's end.
  std::chrono::duration<double> recovery{5};
};

/// The record of one kind of fault.
struct FaultCount {
  int times = 0;
  double longest_recovery_s = 0.0;  ///< of the planner
};

/// The outcome of a soak test.
struct SoakResult {
  std::map<std::uint64_t, Account> accounts;  ///< by session of the service
  Watch::Maps maps;
  std::map<std::string, FaultCount> faults;
  std::uint64_t refused_datagrams = 0;  ///< by all services
  std::vector<std::string> failures;    ///< of recovery, and of processes that ended by themselves or badly

  bool passed() const;
};

/// Runs a fleet for the specified time, with one random fault after another. After every fault a good map
/// must follow, at the planner in time. No process may end by itself, and a process that is told to end must
/// do so in good order. `go_on` is asked between faults. Throws std::runtime_error if the fleet cannot be
/// started or no map comes.
SoakResult soak(const SoakSpec& spec, const std::function<bool()>& go_on);

}  // namespace laneloom::endurance
