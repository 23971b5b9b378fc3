#include <gtest/gtest.h>

#include <memory>
#include <ostream>

#include "experiment/experiment.hpp"
#include "simulation/scenarios.hpp"

/// A few drives with networks, of which nobody tuned for two: no change may lose a point unseen. What a
/// change gains is gained for good: then the figures here are raised.
namespace laneloom::experiment {
namespace {

/// The measured figures, in percent. Differences of libm move them by a small part of the margin.
struct Figures {
  double f1, precision, lanes_f1, linkage_precision, direction_precision;
  double id_switches_per_100_m;
  double blinks_per_s, turned_per_s, own_lane, right_way, gap_p95_m, jump_p99_20_m;  // what a planner takes
};
constexpr double kMargin = 1.0, kMarginPer100_m = 0.1, kMarginPerSecond = 0.1, kMargin_m = 0.05;

struct Network {
  const char* noise;
  Figures measured;
};

void PrintTo(const Network& network, std::ostream* out) { *out << network.noise; }

void expect_as_steady(const evaluation::Steadiness& steadiness, const Figures& measured) {
  const auto percent = [](std::size_t part, std::size_t whole) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  };
  EXPECT_LE(steadiness.per_second(steadiness.blinks), measured.blinks_per_s + kMarginPerSecond);
  EXPECT_LE(steadiness.per_second(steadiness.turned), measured.turned_per_s + kMarginPerSecond);
  EXPECT_GE(percent(steadiness.own_lanes, steadiness.own_wanted), measured.own_lane - kMargin);
  EXPECT_GE(percent(steadiness.right_ways, steadiness.true_ways), measured.right_way - kMargin);
  EXPECT_LE(steadiness.gap_m.quantile(0.95), measured.gap_p95_m + kMargin_m);
  EXPECT_LE(steadiness.jump_m[2].quantile(0.99), measured.jump_p99_20_m + kMargin_m);
}

class Regression : public ::testing::TestWithParam<Network> {};

// All roads are rated together: a single drive differs by points from change to change.
TEST_P(Regression, NoPointIsLost) {
  const auto& [noise, measured] = GetParam();
  ExperimentSpec spec;
  for (const char* road : {"median", "intersection", "split", "street"}) {
    spec.drives.push_back({.road = std::make_shared<const simulation::Road>(simulation::make_scenario(road)),
                           .noise = simulation::noise_profile(noise),
                           .seed = 1});
  }
  spec.configs = {{"laneloom", Config{}}};
  const evaluation::Measures measures = sum(run(spec)).back().measures;
  EXPECT_GE(100.0 * measures.score.markings().f1(), measured.f1 - kMargin);
  EXPECT_GE(100.0 * measures.score.markings().precision(), measured.precision - kMargin);
  EXPECT_GE(100.0 * measures.score.of(evaluation::LineKind::lane).f1(), measured.lanes_f1 - kMargin);
  EXPECT_GE(100.0 * measures.topology.linkages.precision(), measured.linkage_precision - kMargin);
  EXPECT_GE(100.0 * measures.topology.directions.precision(), measured.direction_precision - kMargin);
  EXPECT_LE(0.1 * measures.markings_stability().id_switches_per_km(),
            measured.id_switches_per_100_m + kMarginPer100_m);
  expect_as_steady(measures.steadiness, measured);
}

INSTANTIATE_TEST_SUITE_P(
    Networks, Regression,
    ::testing::Values(
        Network{"inhouse", {86.3, 86.7, 87.7, 95.6, 100.0, 0.25, 0.12, 0.0, 98.1, 95.0, 0.0, 0.17}},
        Network{"random:1", {89.2, 90.5, 91.0, 98.8, 100.0, 0.31, 0.15, 0.0, 96.9, 95.0, 0.0, 0.14}},
        Network{"random:2", {78.1, 75.9, 80.9, 80.7, 97.8, 0.25, 0.37, 0.0, 96.4, 90.2, 0.0, 0.51}}));

}  // namespace
}  // namespace laneloom::experiment
