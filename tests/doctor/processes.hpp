#pragma once

#include <gmock/gmock.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "own_domain.hpp"
#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

/// Real processes over real DDS, in a domain and for a vehicle of this test's own.
class Processes : public testing::Test {
 protected:
  const int domain_ = own_domain();
  const std::string vehicle_ = "car" + std::to_string(getpid());

  std::string file(const std::string& name) const { return folder_.file(name); }

  /// In that domain and for that vehicle, if it is not told otherwise.
  std::vector<std::string> command(std::vector<std::string> words, int domain,
                                   const std::string& vehicle) const {
    words.insert(words.end(), {"--domain", std::to_string(domain), "--vehicle-id", vehicle});
    return words;
  }
  std::vector<std::string> command(std::vector<std::string> words) const {
    return command(std::move(words), domain_, vehicle_);
  }
  std::vector<std::string> service() const { return command({LANELOOM_SERVICE}); }
  static std::vector<std::string> publisher() {
    return {LANELOOM_COMMAND, "publish", "--scenario", "straight", "--loop"};
  }

  /// Runs it until it ends; tells its exit code. What it wrote is output().
  int run(const std::vector<std::string>& words) const {
    return support::ChildProcess(words, file("output")).wait();
  }
  std::string output() const { return content(file("output")); }
  nlohmann::json json() const { return nlohmann::json::parse(output()); }

  /// Runs it again and again, as others take their time, until `wanted` is true of its exit code; for a
  /// minute at most.
  bool run_until(const std::vector<std::string>& words, const std::function<bool(int)>& wanted) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end)
      if (wanted(run(words))) return true;
    return false;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace laneloom
