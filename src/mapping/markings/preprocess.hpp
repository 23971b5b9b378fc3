#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// A detection that passed the filters, in the map frame.
struct ObservedMarking {
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;
  double confidence = 0.0;
  Polyline points;                 ///< map frame
  std::vector<double> stddev_m{};  ///< per point, lateral; empty: not given
};

/// A frame that passed the filters. Refers to the frame as it came.
struct ObservedFrame {
  const DetectionFrame& frame;
  Eigen::Isometry3d T_map_body;  ///< from where it was seen
  std::vector<ObservedMarking> markings;
};

/// Rejects what is likely wrong, by confidence and zigzag, and transforms the rest (paper, Sec. III-A).
std::vector<ObservedMarking> preprocess(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                        const PreprocessConfig& config);

/// Whether consecutive segments turn by more than the configured angle, the configured number of times.
bool is_zigzag(const Polyline& points, const PreprocessConfig& config);

}  // namespace laneloom
