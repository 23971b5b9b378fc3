#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

/// Runs the real `laneloom` and `laneloom-lab`. Command lines are those of a shell whose folder is the test's
/// own; $CONFIG has the configurations that laneloom comes with.
class Commands : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  std::string text(const std::string& name) const { return content(file(name)); }
  nlohmann::json json_of(const std::string& name) const { return nlohmann::json::parse(text(name)); }
  bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }

  /// The exit code of `laneloom` with these words. What it wrote is output().
  virtual int run(const std::string& words) const { return shell("laneloom " + words); }
  int run_lab(const std::string& words) const { return shell("laneloom-lab " + words); }
  /// Whether it ended with exit code 0; else what it wrote.
  testing::AssertionResult done(const std::string& words) const {
    const int code = run(words);
    if (code == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << words << ": ended with " << code << ": " << output();
  }
  int shell(const std::string& line) const {
    return support::ChildProcess(in_folder(line), file("output")).wait();
  }
  std::string output() const { return text("output"); }
  /// Runs one program beside the test, which may send signals to it. It writes to the file `log`.
  support::ChildProcess start(const std::string& program, const std::string& log) const {
    return support::ChildProcess(in_folder("exec " + program), file(log));
  }
  std::vector<std::string> in_folder(const std::string& line) const {
    return {"/bin/bash", "-o", "pipefail", "-c",
            "PATH='" LANELOOM_PROGRAMS "':$PATH; CONFIG='" LANELOOM_CONFIG_DIR "'; cd '" + folder_.path() +
                "' && " + line};
  }

  /// Eight seconds on a straight road; its truth is in truth.json.
  void simulate(const std::string& noise, const std::string& frames) const {
    ASSERT_TRUE(done("simulate --scenario straight --noise " + noise + " --duration 8 --frames " + frames +
                     " --truth truth.json"));
  }

 private:
  const TemporaryFolder folder_;
};

}  // namespace laneloom
