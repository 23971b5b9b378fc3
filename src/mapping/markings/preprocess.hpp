#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom::markings {

/// A detection that passed the filters, in the map frame.
struct ObservedMarking {
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;
  double confidence = 0.0;         ///< 0..1, as it was told; of joined dashes the mean
  Polyline points;                 ///< map frame
  std::vector<double> stddev_m{};  ///< lateral standard deviation per point; empty: not given
  double belief = 0.0;     ///< 0..1, on the scale of all networks; of joined dashes that of all together
  std::size_t number = 0;  ///< of the detection in its frame; of joined dashes that of the first one
};

/// A frame with those of its detections that passed the filters.
struct ObservedFrame {
  const DetectionFrame& frame;   ///< as it was received
  Eigen::Isometry3d T_map_body;  ///< pose at the frame's stamp
  std::vector<ObservedMarking> markings;
};

/// Rejects zigzagging detections, and transforms the rest to the map frame (paper, Sec. III-A). Believes the
/// confidences as they are told.
std::vector<ObservedMarking> preprocess(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                        const PreprocessConfig& config);

/// Rejects what is of low confidence (paper, Sec. III-A), unless its network is as unsure of lines that are
/// there. Returns the number of those that it rejected.
std::size_t drop_unsure(const PreprocessConfig& config, std::vector<ObservedMarking>& markings);

/// Whether consecutive segments turn by more than the configured angle, the configured number of times in a
/// row. Of a road edge, only turns to alternating sides count, because islands have outlines; one more is
/// needed, because kerbs step aside; and one that leads backwards counts as two.
bool is_zigzag(const Polyline& points, MarkingType type, const PreprocessConfig& config);

}  // namespace laneloom::markings
