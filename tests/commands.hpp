#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

/// Runs the real `laneloom` and `laneloom-lab` in a folder of their own.
class Commands : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  /// Its exit code. What it wrote is output().
  int run(const std::vector<std::string>& arguments) const { return run(LANELOOM_COMMAND, arguments); }
  int run_lab(const std::vector<std::string>& arguments) const { return run(LANELOOM_LAB, arguments); }
  std::string output() const { return content(file("output")); }

  /// Eight seconds on a straight road; its truth is in truth.json.
  void simulate(const std::string& noise, const std::string& frames) const {
    ASSERT_EQ(run({"simulate", "--scenario", "straight", "--noise", noise, "--duration", "8", "--frames",
                   file(frames), "--truth", file("truth.json")}),
              0)
        << output();
  }

 private:
  int run(const std::string& program, const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return support::ChildProcess(words, file("output")).wait();
  }

  const TemporaryFolder folder_;
};

}  // namespace laneloom
