#include "service/service.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "end_to_end/participants.hpp"
#include "service/signals.hpp"

namespace laneloom {
namespace {

bool has_ages(const ServiceStatus& status) {
  return status.detections_age_s != -1.0 && status.poses_age_s != -1.0;
}
bool has_stamp(const PublishedMap& map) { return map.map.stamp_ns > 0; }
/// Or -1: nothing came yet.
bool is_age(double age_s) { return age_s >= 0.0 || age_s == -1.0; }

Tick tick_that_began_a_while_ago() {
  const auto start_ns = steady_now_ns() - 200'000'000;  // frames come every 100 ms
  return {.deadline_ns = start_ns, .start_ns = start_ns};
}

// A tick takes its time, and what arrives meanwhile is newer than its start.
TEST(ServiceTick, NoAgeIsNegative) {
  Config config;
  config.dds = private_config();
  config.service.status_period_s = 0.1;
  Service service(config, steady_now_ns);
  Listener<PublishedMap> maps(config.dds);
  Listener<ServiceStatus> status(config.dds);
  const StraightRoad road(config.dds);
  const auto ticks_until = [&](auto& listener, const auto& wanted) {
    for (int i = 0; i < 300; ++i) {
      service.tick(tick_that_began_a_while_ago());
      if (listener.wait_for(wanted, std::chrono::milliseconds(100))) return true;
    }
    return false;
  };
  ASSERT_TRUE(ticks_until(status, has_ages));
  ASSERT_TRUE(ticks_until(maps, has_stamp));
  for (const auto& said : status.samples()) {
    EXPECT_PRED1(is_age, said.detections_age_s);
    EXPECT_PRED1(is_age, said.poses_age_s);
    EXPECT_GE(said.uptime_s, 0.0);
  }
  for (const auto& map : maps.samples()) EXPECT_PRED1(is_age, map.age_s);
}

}  // namespace
}  // namespace laneloom
