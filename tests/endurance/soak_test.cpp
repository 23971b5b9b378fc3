#include "endurance/soak.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/work_folder.hpp"

// What a soak finds wrong with real processes; that it finds nothing wrong with healthy ones is the test
// `soak`.
namespace laneloom {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// After one fault, with this shell command as the planner.
SoakResult soak_with_planner(const std::string& planner) {
  const WorkFolder folder;
  const std::string command = folder.file("laneloom");
  std::ofstream(command) << "#!/bin/sh\n[ $1 = pnc ] && exec " << planner << "\nexec " LANELOOM " \"$@\"\n";
  std::filesystem::permissions(command, std::filesystem::perms{0700});

  SoakSpec spec;
  spec.fleet.service = LANELOOMD;
  spec.fleet.command = command;
  spec.fleet.dds.domain = 91;
  spec.fleet.dds.vehicle_id = "soak_test_" + std::to_string(getpid());
  spec.patience = std::chrono::seconds(10);
  int faults = 0;
  return soak(spec, [&] { return faults++ < 1; });
}

TEST(Soak, FailsWhereThePlannerGetsNoMap) {
  const auto result = soak_with_planner("sleep 1000");
  EXPECT_THAT(result.failures, Contains(HasSubstr("the planner got no map after: ")));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, FailsWhereAProcessEndsByItself) {
  const auto result = soak_with_planner("true");
  EXPECT_THAT(result.failures, Contains(HasSubstr("the planner ended after: ")));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, PassesWhereNothingIsWrong) {
  const auto result = soak_with_planner(LANELOOM " \"$@\"");
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_TRUE(result.passed());
}

}  // namespace
}  // namespace laneloom
