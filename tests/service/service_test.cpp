#include "service/service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "end_to_end/participants.hpp"
#include "service/signals.hpp"

namespace laneloom {
namespace {

bool is_any(const VehiclePose& /*pose*/) { return true; }
bool has_poses(const ServiceStatus& status) { return status.poses_age_s != -1.0; }

// A tick takes its time, and what arrives meanwhile is newer than its start.
TEST(ServiceTick, NoAgeIsNegative) {
  Config config;
  config.dds = private_config();
  config.service.status_period_s = 0.1;
  Service service(config, steady_now_ns);
  Listener<PublishedMap> maps(config.dds);
  Listener<ServiceStatus> status(config.dds);
  Listener<VehiclePose> poses(config.dds);
  const auto started_ns = steady_now_ns();
  const StraightRoad road(config.dds);
  ASSERT_TRUE(poses.wait_for(is_any));
  usleep(300'000);  // frames come every 100 ms
  for (std::int64_t i = 0; i < 10; ++i) {
    service.tick({.deadline_ns = started_ns, .start_ns = started_ns + i});
    usleep(20'000);
  }
  service.tick({.deadline_ns = started_ns, .start_ns = steady_now_ns()});
  ASSERT_TRUE(status.wait_for(has_poses));
  for (const auto& said : status.samples()) {
    EXPECT_GE(said.detections_age_s, 0.0);
    EXPECT_GE(said.poses_age_s, 0.0);
    EXPECT_GE(said.uptime_s, 0.0);
  }
  ASSERT_TRUE(maps.wait_for([](const PublishedMap& map) { return map.map.stamp_ns > 0; }));
  for (const auto& map : maps.samples()) EXPECT_GE(map.age_s, 0.0);
}

}  // namespace
}  // namespace laneloom
