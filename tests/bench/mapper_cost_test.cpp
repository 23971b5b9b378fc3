#include "bench/mapper_cost.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/process_usage.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::bench {
namespace {

std::vector<experiment::SimulatedFrame> frames(double duration_s) {
  return experiment::simulate(
      {.road = std::make_shared<const simulation::Road>(simulation::make_scenario("straight")),
       .noise = simulation::noise_profile("none"),
       .duration_s = duration_s});
}

TEST(Summarise, ByNearestRank) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const TimeSummary summary = support::summarise(values);
  EXPECT_DOUBLE_EQ(summary.mean_ms, 100.5);
  EXPECT_DOUBLE_EQ(summary.p50_ms, 100.0);
  EXPECT_DOUBLE_EQ(summary.p99_ms, 198.0);
  EXPECT_DOUBLE_EQ(summary.max_ms, 200.0);
  EXPECT_DOUBLE_EQ(support::summarise({}).max_ms, 0.0);
  EXPECT_DOUBLE_EQ(support::summarise({4.0}).p99_ms, 4.0);
}

TEST(MapperCost, HasEveryUpdateAndWhatItAllocated) {
  const std::vector<experiment::SimulatedFrame> drive = frames(3.0);
  const MapperCost cost = measure(MapperConfig{}, drive);
  ASSERT_EQ(cost.update_ms.size(), 30U);
  ASSERT_EQ(cost.allocations.size(), 30U);
  EXPECT_TRUE(cost.stages.reached(Stage::association));
  EXPECT_FALSE(cost.stages.reached(Stage::clustering));
  EXPECT_GE(cost.update().mean_ms, cost.stages.total().mean_ms);
  EXPECT_GT(cost.markings_per_map(), 1.0);
  EXPECT_GT(cost.heap_bytes, 1000);
  EXPECT_GT(cost.peak_heap_bytes, cost.heap_bytes);

  // The mapper is the same each time, and so are its allocations.
  EXPECT_EQ(measure(MapperConfig{}, drive).allocations, cost.allocations);
}

TEST(MapperMeter, StartsAnewWhenItsCostIsTaken) {
  MapperMeter meter(MapperConfig{}, true);
  const std::vector<experiment::SimulatedFrame> drive = frames(0.5);
  for (const experiment::SimulatedFrame& frame : drive) meter.update(frame.record);
  EXPECT_EQ(meter.take_cost().update_ms.size(), 5U);
  meter.update(drive.back().record);
  const MapperCost last = meter.take_cost();
  EXPECT_EQ(last.update_ms.size(), 1U);
  EXPECT_GT(last.heap_bytes, 0);
}

TEST(ProcessUsage, GrowsWithWhatIsUsed) {
  const double now_mb = rss_mb(getpid()), peak_mb = peak_rss_mb(getpid()), used_s = cpu_s(getpid());
  EXPECT_GE(peak_mb + 1.0, now_mb);  // the kernel counts pages in batches
  {
    const std::vector<char> touched(64U << 20U, 1);
    EXPECT_GT(rss_mb(getpid()), 64.0);
    EXPECT_EQ(touched.back(), 1);
  }
  EXPECT_GT(peak_rss_mb(getpid()), std::max(peak_mb, 64.0));
  EXPECT_GT(cpu_s(getpid()), used_s);
  EXPECT_ANY_THROW(rss_mb(-1));
  EXPECT_ANY_THROW(cpu_s(-1));
}

}  // namespace
}  // namespace laneloom::bench
