#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/line_map.hpp"
#include "mapping/preprocess.hpp"

namespace laneloom {

/// A sample of a detection with its foot on a line.
struct SampleMatch {
  std::size_t sample = 0;
  StationFoot foot;
};

/// What one detection says of one line.
struct LineMatch {
  std::size_t detection = 0;
  std::size_t line = 0;
  std::vector<SampleMatch> samples;  ///< ascending; at least two
};

/// A detection, sampled evenly.
struct SampledDetection {
  Polyline samples;  ///< map frame, `sample_step_m` apart
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;
  double confidence = 0.0;
  std::vector<bool> explained;  ///< per sample: some line was matched to it
};

std::vector<SampledDetection> sample_detections(const std::vector<ObservedMarking>& markings,
                                                const FusionConfig& config);

/// Which detection observes which line: pairs that lie close and run alike, the best fit first. No place of a
/// line is observed by two detections of one frame, since what is seen side by side is not one line; no
/// sample observes two lines. Marks the explained samples.
std::vector<LineMatch> associate(const std::vector<Line>& lines, const FusionConfig& config,
                                 std::vector<SampledDetection>& detections);

}  // namespace laneloom
