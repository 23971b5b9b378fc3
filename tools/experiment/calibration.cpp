#include "experiment/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiment/experiment.hpp"

namespace laneloom::experiment {
namespace {

// Share of the change that each figure alone would need, since the figures depend on one another.
constexpr double kDamping = 0.6;
constexpr double kMaxMissedShare = 0.6;
constexpr double kFramesPerSecond = 10.0;

CalibrationStep measure(const simulation::NoiseProfile& noise, std::vector<DriveSpec>& drives,
                        const RangeConfig& range) {
  for (DriveSpec& drive : drives) drive.noise = noise;
  const evaluation::Measures raw =
      sum(run({.drives = drives, .configs = {}, .peer = {}, .range = range})).front().measures;
  return {noise, raw.score, raw.markings_stability().jitter_m.mean()};
}

double towards(double value, double is, double should) {
  return is > 0.0 ? value * std::pow(should / is, kDamping) : value;
}

void correct(const CalibrationStep& step, const CalibrationTarget& target, simulation::NoiseProfile& noise) {
  const double seconds = static_cast<double>(step.score.frames) / kFramesPerSecond;
  for (const MarkingType type : kMarkingTypes) {
    const CalibrationTarget::Kind& should = target.kinds.at(index(type));
    const evaluation::Score& is = step.score.of(evaluation::line_kind(type));
    if (should.precision <= 0.0 || is.truths == 0) continue;
    double& missed = noise.missed_share.at(index(type));
    missed = std::clamp(missed + kDamping * (is.recall() - should.recall), 0.0, kMaxMissedShare);
    // A ghost is a wrong detection in every frame of its life.
    const double wrong = static_cast<double>(is.predictions - is.matches);
    const double wrong_should = static_cast<double>(is.matches) * (1.0 / should.precision - 1.0);
    double& ghosts = noise.ghost_rate_hz.at(index(type));
    ghosts += kDamping * (wrong_should - wrong) / (seconds * kFramesPerSecond * mean_ghost_life_s(noise));
    ghosts = std::max(0.0, ghosts);
    double& factor = noise.error_factor.at(index(type));
    factor = std::clamp(towards(factor, is.acd_m(), should.acd_m), 0.2, 5.0);
  }
  noise.flutter_stddev_m = towards(noise.flutter_stddev_m, step.jitter_m, target.jitter_m);
}

}  // namespace

CalibrationTarget calibration_target(const std::string& data_set) {
  if (data_set == "inhouse")
    return {{{{0.772, 0.746, 0.164}, {0.618, 0.703, 0.148}, {0.719, 0.768, 0.167}}}, 0.063};
  if (data_set == "av2") return {{{{0.719, 0.662, 0.134}, {0.543, 0.514, 0.176}, {}}}, 0.045};
  throw std::invalid_argument("no calibration target is known for '" + data_set + "'");
}

CalibrationStep calibrate(simulation::NoiseProfile start, const CalibrationTarget& target,
                          std::vector<DriveSpec> drives, const RangeConfig& range, int steps,
                          const std::function<void(const CalibrationStep&)>& tell) {
  CalibrationStep step = measure(start, drives, range);
  tell(step);
  for (int i = 1; i < steps; ++i) {
    correct(step, target, start);
    step = measure(start, drives, range);
    tell(step);
  }
  return step;
}

}  // namespace laneloom::experiment
