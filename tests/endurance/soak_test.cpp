#include "endurance/soak.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "io/work_folder.hpp"
#include "own_domain.hpp"

// A soak finds what is wrong with real processes. The test `soak` shows that it finds nothing wrong with
// healthy ones.
namespace laneloom::endurance {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SoakSpec healthy() {
  SoakSpec spec;
  spec.fleet.service = LANELOOMD;
  spec.fleet.command = LANELOOM;
  spec.fleet.dds.domain = own_domain();
  spec.fleet.dds.vehicle_id = "soak_test_" + std::to_string(getpid());
  spec.patience = std::chrono::seconds(30);
  return spec;
}

SoakResult soak_with(const SoakSpec& spec, int faults) {
  int made = 0;
  return soak(spec, [&] { return made++ < faults; });
}

void write_script(const std::string& file, const std::string& script) {
  std::ofstream(file) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(file, std::filesystem::perms{0700});
}

/// With this shell script as the command `laneloom`.
SoakResult soak_with_command(const std::string& script, int faults, SoakSpec spec = healthy()) {
  const io::WorkFolder folder;
  spec.fleet.command = folder.file("laneloom");
  write_script(spec.fleet.command, script + "\nexec " LANELOOM " \"$@\"");
  return soak_with(spec, faults);
}

/// After one fault, with this shell command as the planner.
SoakResult soak_with_planner(const std::string& planner, SoakSpec spec = healthy()) {
  return soak_with_command("[ $1 = pnc ] && exec " + planner, 1, std::move(spec));
}

/// A soak that need not wait long for what does not come.
SoakSpec impatient() {
  SoakSpec spec = healthy();
  spec.patience = std::chrono::seconds(10);
  return spec;
}

/// One expectation for each thing that makes a soak fail, so that a failed test tells which it was.
void expect_passed(const SoakResult& result) {
  EXPECT_THAT(result.failures, IsEmpty());
  EXPECT_THAT(result.maps.violations, IsEmpty());
  for (const auto& [session, account] : result.accounts)
    EXPECT_EQ(account.unexplained(), 0)
        << "published " << account.published << ", fused " << account.fused << ", refused " << account.refused
        << ", dropped " << account.dropped << ", pending " << account.pending << ", lost " << account.lost;
  EXPECT_TRUE(result.passed());
}

TEST(Soak, FailsWhereThePlannerGetsNoMap) {
  const auto result = soak_with_planner("sleep 1000", impatient());
  EXPECT_THAT(result.failures, Contains(HasSubstr("the planner got no map after: ")));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, FailsWhereAProcessEndsByItself) {
  const auto result = soak_with_planner("sh -c 'echo tired; exit 3'", impatient());
  EXPECT_THAT(
      result.failures,
      Contains(HasSubstr("the planner ended with exit code 3 by itself (its last words: tired) after: ")));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, FailsWhereAProcessThatIsToldToEndCrashes) {
  const auto result = soak_with_command(
      "if [ $1 = publish ]; then\n"
      "  " LANELOOM
      " \"$@\" & child=$!\n"
      "  trap 'kill -TERM $child; wait $child; kill -SEGV $$' TERM\n"
      "  while :; do sleep 0.1; done\n"
      "fi",
      0);
  EXPECT_THAT(result.failures, Contains("the publisher, told to end, ended by signal 11"));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, FailsWhereThePlannerRecoversTooLate) {
  SoakSpec spec = healthy();
  spec.recovery = std::chrono::milliseconds(1);
  const auto result = soak_with(spec, 1);
  EXPECT_THAT(result.failures, Contains(HasSubstr("the planner got a map only ")));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, FailsWhereNothingOfAnotherPerceptionIsFused) {
  const io::WorkFolder folder;
  SoakSpec spec = healthy();
  spec.fleet.perceptions = {folder.file("idler")};
  write_script(spec.fleet.perceptions.front(), "echo session_id,sequence,published_ns >$3\nexec sleep 1000");
  const auto result = soak_with(spec, 0);
  EXPECT_THAT(result.failures, Contains("no frame of the idler was fused"));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, HasAnotherVendorsPerceptionAmongItsActors) {
  SoakSpec spec = healthy();
  spec.fleet.perceptions = {STOCK_PERCEPTION};
  expect_passed(soak_with(spec, 3));
}

TEST(Soak, FailsWhereNothingOfTheStrangerIsRefused) {
  const io::WorkFolder folder;
  SoakSpec spec = healthy();
  spec.fleet.stranger = {folder.file("shy")};
  write_script(spec.fleet.stranger.front(), "trap 'exit 0' TERM; while :; do sleep 0.1; done");
  const auto result = soak_with(spec, 0);
  EXPECT_THAT(result.failures, ElementsAre("nothing of the stranger was refused"));
  EXPECT_FALSE(result.passed());
}

TEST(Soak, HasAStrangerAmongItsActors) {
  SoakSpec spec = healthy();
  spec.fleet.perceptions = {STOCK_PERCEPTION};
  spec.fleet.stranger = {STRANGER, LANELOOM_CAPTURES "/laneloom.pcap", LANELOOM_CAPTURES "/fast_dds.pcap"};
  const auto result = soak_with(spec, 3);
  expect_passed(result);
  EXPECT_GT(result.refused_datagrams, 0U);
}

TEST(Soak, PassesWhereNothingIsWrong) { expect_passed(soak_with_planner(LANELOOM " \"$@\"")); }

}  // namespace
}  // namespace laneloom::endurance
