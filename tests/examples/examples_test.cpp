#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "end_to_end/process.hpp"
#include "own_domain.hpp"

// A service, a perception and a planner; the planner's words are the proof.
namespace laneloom {
namespace {

const std::string kVehicle = "example";

Process service() {
  return Process({LANELOOMD, "--domain", std::to_string(own_domain()), "--vehicle-id", kVehicle});
}

/// The command of an example, all of whose output can be waited for.
std::vector<std::string> example(const std::string& program, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"/bin/sh", "-c", R"(exec "$0" "$@" >&2)", program};
  words.insert(words.end(), {std::to_string(own_domain()), kVehicle});
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void expect_lane(const std::string& perception, const std::string& planner, const std::string& words) {
  const Process service = laneloom::service();
  const Process perceives(example(perception));
  const Process plans(example(planner));
  EXPECT_TRUE(plans.wait_for_error(words)) << plans.errors() << service.errors() << perceives.errors();
}

TEST(Examples, OurPlannerKnowsItsWay) {
  expect_lane(CPP_PERCEPTION, CPP_PLANNER, " m\n  it may change to the left");
}

TEST(Examples, OurPlannerKnowsTheWayAlongAWishedTurn) {
  const Process service = laneloom::service();
  const Process publishes({LANELOOM, "publish", "--scenario", "intersection", "--loop", "--domain",
                           std::to_string(own_domain()), "--vehicle-id", kVehicle});
  const Process plans(example(CPP_PLANNER, {"left"}));
  EXPECT_TRUE(plans.wait_for_error(", left\n")) << plans.errors();
}

#ifdef C_PLANNER
TEST(Examples, CycloneReadsLanesOfWhatCycloneSees) { expect_lane(C_PERCEPTION, C_PLANNER, "width 3.50 m"); }

TEST(Examples, CycloneReadsLanesOfWhatFastDdsSees) { expect_lane(CPP_PERCEPTION, C_PLANNER, "width 3.50 m"); }
#endif

// The maps of two services come in turn, with unrelated ids.
void expect_stop_for_two_services(const std::string& planner, const std::string& words) {
  const Process service = laneloom::service();
  const Process another = laneloom::service();
  const Process perceives(example(CPP_PERCEPTION));
  const Process plans(example(planner));
  EXPECT_TRUE(plans.wait_for_error(words)) << plans.errors() << service.errors() << another.errors();
}

TEST(Examples, OurPlannerStopsForASecondService) {
  expect_stop_for_two_services(CPP_PLANNER, "DEGRADED another_service\nno map to drive on\n");
}

#ifdef C_PLANNER
TEST(Examples, APlannerOnCycloneStopsForASecondService) {
  expect_stop_for_two_services(C_PLANNER, "no map to drive on: two services write maps in turn\n");
}
#endif

void expect_stop_when_the_service_hangs(const std::string& planner, const std::string& goes) {
  const Process service = laneloom::service();
  const Process perceives(example(CPP_PERCEPTION));
  const Process plans(example(planner));
  ASSERT_TRUE(plans.wait_for_error(goes)) << plans.errors() << service.errors();
  service.signal(SIGSTOP);
  EXPECT_TRUE(plans.wait_for_error("no map came for 300 ms: stop\n")) << plans.errors();
  service.signal(SIGCONT);
}

TEST(Examples, OurPlannerStopsWhenTheServiceHangs) {
  expect_stop_when_the_service_hangs(CPP_PLANNER, " m left of its way");
}

#ifdef C_PLANNER
TEST(Examples, APlannerOnCycloneStopsWhenTheServiceHangs) {
  expect_stop_when_the_service_hangs(C_PLANNER, "width 3.50 m");
}
#endif

TEST(Examples, WrongUseIsSaid) {
  for (const std::string program : {CPP_PERCEPTION, CPP_PLANNER}) {
    Process process({program});
    EXPECT_EQ(process.wait(), 1);
    EXPECT_NE(process.errors().find("usage: "), std::string::npos);
  }
}

}  // namespace
}  // namespace laneloom
