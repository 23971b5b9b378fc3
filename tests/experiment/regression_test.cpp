#include <gtest/gtest.h>

#include <memory>
#include <ostream>

#include "experiment/experiment.hpp"
#include "simulation/scenarios.hpp"

/// A few drives with networks that nobody tuned for: no change may lose a point unseen. What a change gains
/// is gained for good: then the figures here are raised.
namespace laneloom::experiment {
namespace {

/// The measured figures, in percent. Differences of libm move them by a small part of the margin.
struct Figures {
  double f1, lanes_f1, direction_precision;
};
constexpr double kMargin = 1.0;

struct Network {
  const char* noise;
  Figures measured;
};

void PrintTo(const Network& network, std::ostream* out) { *out << network.noise; }

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
  EXPECT_GE(100.0 * measures.score.of(evaluation::LineKind::lane).f1(), measured.lanes_f1 - kMargin);
  EXPECT_GE(100.0 * measures.topology.directions.precision(), measured.direction_precision - kMargin);
}

INSTANTIATE_TEST_SUITE_P(Networks, Regression,
                         ::testing::Values(Network{"random:1", {89.1, 87.3, 99.9}},
                                           Network{"random:2", {74.0, 70.5, 100.0}}));

}  // namespace
}  // namespace laneloom::experiment
