#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/nearest_stations.hpp"
#include "mapping/markings/preprocess.hpp"

namespace laneloom {

/// A sample of a detection with its foot on a line.
struct SampleMatch {
  std::size_t sample = 0;
  StationFoot foot;
};

/// Whether the line leads from the one foot to the other. It does not where a closed line ends and begins.
bool is_led_through(const SampleMatch& from, const SampleMatch& to);

/// What one detection says of one line.
struct LineMatch {
  std::size_t detection = 0;
  std::size_t line = 0;
  std::vector<SampleMatch> samples;  ///< ascending; at least two
};

/// A detection, sampled evenly.
struct SampledDetection {
  Polyline samples;        ///< map frame, evenly spaced
  double spacing_m = 0.0;  ///< of the samples along the detection, at most `sample_step_m`
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;
  double confidence = 0.0;
  std::vector<double> stddev_m{};  ///< per sample, lateral; empty: not given
  std::vector<bool> explained{};   ///< per sample: some line accounts for it

  /// How much of the detection a sample stands for, in metres: half of the way to either neighbour.
  double share_m(std::size_t sample) const {
    return sample == 0 || sample + 1 == samples.size() ? 0.5 * spacing_m : spacing_m;
  }
};

std::vector<SampledDetection> sample_detections(const std::vector<ObservedMarking>& markings,
                                                const FusionConfig& config);

/// What one frame says of the lines.
struct Association {
  std::vector<SampledDetection> detections;
  std::vector<LineMatch> matches;
};

/// Tells which detection observes which of the lines of one instant. Not thread-safe.
class LineMatcher {
 public:
  /// `lines` have to stay as they are.
  LineMatcher(const std::vector<Line>& lines, const FusionConfig& config);

  /// Pairs that lie close and run alike, the best fit first. No place of a line is observed by two detections
  /// of one frame, since what is seen side by side is not one line; no sample observes two lines. Looks at
  /// every `stride`-th sample only.
  std::vector<LineMatch> match(const std::vector<SampledDetection>& detections, std::size_t stride = 1);

  const std::vector<Line>& lines() const { return lines_; }
  const FusionConfig& config() const { return config_; }

 private:
  /// A line that a detection lies beside, with `count` samples from `from` on.
  struct Candidate {
    double score = 0.0;
    std::size_t detection = 0, line = 0;
    std::size_t from = 0, count = 0;
  };
  struct Candidates {
    std::vector<Candidate> all;
    std::vector<SampleMatch> samples;
  };
  /// Of one detection on one line, so far.
  struct Found {
    double score = 0.0;
    std::size_t samples = 0;
    std::size_t next = 0;  ///< place of the next sample among those of all candidates
  };
  struct Hit {
    std::uint32_t line = 0;
    SampleMatch sample;
  };

  std::optional<StationFoot> foot(const NearestStation& nearest, const Point& sample,
                                  const Eigen::Vector2d& direction) const;
  void find_candidates(std::size_t index, const SampledDetection& detection, std::size_t stride,
                       Candidates& candidates);
  void group_hits(std::size_t detection, Candidates& candidates);

  const std::vector<Line>& lines_;
  FusionConfig config_;
  double min_cosine_;
  NearestStations along_, across_;
  std::vector<Course> courses_;  ///< of the lines
  // Of one detection, and empty between two of them.
  std::vector<Found> found_;  ///< by line
  std::vector<Hit> hits_;
};

/// Matches the detections, and marks the samples that were matched.
Association associate(LineMatcher& matcher, std::vector<SampledDetection> detections);

}  // namespace laneloom
