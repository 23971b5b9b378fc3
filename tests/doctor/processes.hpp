#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <string>

#include "commands.hpp"
#include "own_domain.hpp"

namespace laneloom {

/// Real processes over real DDS, in a domain and for a vehicle of this test's own.
class Processes : public Commands {
 protected:
  static std::string of(int domain, const std::string& vehicle) {
    return " --domain " + std::to_string(domain) + " --vehicle-id " + vehicle + " ";
  }

  const int domain_ = own_domain();
  const std::string vehicle_ = "car" + std::to_string(getpid());
  const std::string here_ = of(domain_, vehicle_);
  const std::string service_ = "laneloomd" + here_;
  const std::string publisher_ = "laneloom publish --scenario straight --loop";

  nlohmann::json json() const { return nlohmann::json::parse(output()); }

  /// Runs it again and again, as others take their time, until `wanted` is true of its exit code; for a
  /// minute at most.
  bool run_until(const std::string& words, const std::function<bool(int)>& wanted) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end)
      if (wanted(run(words))) return true;
    return false;
  }
};

}  // namespace laneloom
