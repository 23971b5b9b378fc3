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
  std::uint64_t seed = 1;  ///< of the faults
};

struct SoakResult {
  std::map<std::uint64_t, Account> accounts;  ///< by session of the service
  Watch::Maps maps;
  std::map<std::string, int> faults;     ///< how often each was made
  std::vector<std::string> unrecovered;  ///< faults after which no good map came

  bool passed() const;
};

/// Runs a fleet for so long, with one random fault after another; every fault ends, and a good map must
/// follow. `go_on` is asked between faults. Throws std::runtime_error where the fleet cannot be started or no
/// map comes.
SoakResult soak(const SoakSpec& spec, const std::function<bool()>& go_on);

}  // namespace laneloom
