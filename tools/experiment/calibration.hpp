#pragma once

#include <array>
#include <functional>
#include <vector>

#include "evaluation/evaluation.hpp"
#include "experiment/drive_simulation.hpp"

namespace laneloom::experiment {

/// The scores that a network's single detections should have. Markings without a target have a precision of
/// 0.
struct CalibrationTarget {
  struct Kind {
    double precision = 0.0, recall = 0.0;  ///< 0..1
    double acd_m = 0.0;
  };
  std::array<Kind, kMarkingTypeCount> kinds;
  double jitter_m = 0.0;  ///< mean lateral displacement between consecutive frames, of all markings
};

/// The scores that the paper reports of MapTR on its data sets "inhouse" and "av2" (Table I). The jitter is
/// not in the paper. It is that of single detections under another model of MapTR's noise.
CalibrationTarget calibration_target(const std::string& data_set);

/// A noise profile that was tried, and the scores under it.
struct CalibrationStep {
  simulation::NoiseProfile noise;
  evaluation::MapScore score;  ///< of single detections under this noise
  double jitter_m = 0.0;
};

/// Changes a profile's missed shares (for the recall), ghost rates (precision), error factors (ACD) and
/// flutter (jitter), in `steps` steps, so that single detections approach the target's scores. `drives` name
/// road, seed and duration. `tell` is called with every step. Returns the last step.
CalibrationStep calibrate(simulation::NoiseProfile start, const CalibrationTarget& target,
                          std::vector<DriveSpec> drives, const RangeConfig& range, int steps,
                          const std::function<void(const CalibrationStep&)>& tell);

}  // namespace laneloom::experiment
