#include "ros2/diagnostics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

namespace laneloom::ros2 {
namespace {

std::map<std::string, std::string> values_of(const diagnostic_msgs::msg::dds_::DiagnosticStatus_& status) {
  std::map<std::string, std::string> values;
  for (const auto& value : status.values()) values[value.key()] = value.value();
  return values;
}

TEST(Diagnostics, TellStateReasonsAndCounters) {
  ServiceStatus status;
  status.published_ns = 1'700'000'000'000'000'007;
  status.state = MapState::degraded;
  status.reasons = {StateReason::no_poses, StateReason::overloaded};
  status.poses_age_s = 0.25;
  status.version = "0.1.0";
  status.counters = {{"poses_lost", 3}};
  status.sources.push_back({"camera", 1, 1, 9, 9, 8});
  const auto array = to_diagnostics(status, "/car_1/laneloom", "car-1");
  EXPECT_EQ(array.header().stamp().sec(), 1'700'000'000);
  EXPECT_EQ(array.header().stamp().nanosec(), 7U);
  ASSERT_EQ(array.status().size(), 1U);
  const auto& map = array.status()[0];
  EXPECT_EQ(map.level(), 1);
  EXPECT_EQ(map.name(), "/car_1/laneloom: lane map");
  EXPECT_EQ(map.message(), "DEGRADED no_poses overloaded");
  EXPECT_EQ(map.hardware_id(), "car-1");
  const auto values = values_of(map);
  EXPECT_EQ(values.at("poses_age_s"), "0.250");
  EXPECT_EQ(values.at("poses_lost"), "3");
  EXPECT_EQ(values.at("source camera fused"), "8");
  EXPECT_EQ(values.at("version"), "0.1.0");
}

TEST(Diagnostics, HaveALevelForEachState) {
  const auto level = [](MapState state) {
    ServiceStatus status;
    status.state = state;
    return static_cast<int>(to_diagnostics(status, "/laneloom", "ego").status()[0].level());
  };
  EXPECT_EQ(level(MapState::ok), 0);
  EXPECT_EQ(level(MapState::degraded), 1);
  EXPECT_EQ(level(MapState::stale), 3);
}

}  // namespace
}  // namespace laneloom::ros2
