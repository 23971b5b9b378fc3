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

struct Drive {
  const char* scenario;
  const char* network;
  Figures measured;
};

void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.scenario << " " << drive.network; }

class Regression : public ::testing::TestWithParam<Drive> {};

TEST_P(Regression, NoPointIsLost) {
  const auto& [scenario, network, measured] = GetParam();
  ExperimentSpec spec;
  spec.drives = {{.road = std::make_shared<const simulation::Road>(simulation::make_scenario(scenario)),
                  .noise = simulation::noise_profile(network),
                  .seed = 1}};
  spec.configs = {{"laneloom", Config{}}};
  const evaluation::Measures measures = run(spec).front().back().measures;
  EXPECT_GE(100.0 * measures.score.markings().f1(), measured.f1 - kMargin);
  EXPECT_GE(100.0 * measures.score.of(evaluation::LineKind::lane).f1(), measured.lanes_f1 - kMargin);
  EXPECT_GE(100.0 * measures.topology.directions.precision(), measured.direction_precision - kMargin);
}

INSTANTIATE_TEST_SUITE_P(Drives, Regression,
                         ::testing::Values(Drive{"median", "random:1", {92.5, 96.7, 99.9}},
                                           Drive{"median", "random:2", {70.8, 76.4, 100.0}},
                                           Drive{"intersection", "random:1", {87.8, 88.0, 100.0}},
                                           Drive{"intersection", "random:2", {69.2, 80.3, 100.0}}));

}  // namespace
}  // namespace laneloom::experiment
