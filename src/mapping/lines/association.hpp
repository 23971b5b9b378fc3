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

namespace laneloom::lines {

/// A sample of a detection with its foot on a line.
struct SampleMatch {
  std::size_t sample = 0;  ///< index of the sample in its detection
  StationFoot foot;
};

/// Whether the line leads from one foot to the other. It does not where the feet lie at the two ends of a
/// closed line.
bool is_led_through(const SampleMatch& from, const SampleMatch& to);

/// A detection that observes a line, with the samples that do.
struct LineMatch {
  std::size_t detection = 0;         ///< index
  std::size_t line = 0;              ///< index
  std::vector<SampleMatch> samples;  ///< in ascending order; at least two
};

/// A detection, sampled evenly.
struct SampledDetection {
  Polyline samples;        ///< map frame, evenly spaced
  double spacing_m = 0.0;  ///< between samples along the detection, at most `sample_step_m`
  MarkingType type = MarkingType::laneline;
  MarkingStyle style = MarkingStyle::unknown;
  double confidence = 0.0, belief = 0.0;  ///< as in markings::ObservedMarking
  std::vector<double> stddev_m{};         ///< lateral standard deviation per sample; empty: not given
  std::vector<bool> explained{};          ///< per sample: a line observed it, or was extended by it
  std::size_t number = 0;                 ///< as in markings::ObservedMarking

  /// The length of the detection that a sample stands for, in metres: half of the way to each neighbour.
  double share_m(std::size_t sample) const {
    return sample == 0 || sample + 1 == samples.size() ? 0.5 * spacing_m : spacing_m;
  }
};

std::vector<SampledDetection> sample_detections(const std::vector<markings::ObservedMarking>& markings,
                                                const FusionConfig& config);

/// The detections of a frame, and the lines that they observe.
struct Association {
  std::vector<SampledDetection> detections;
  std::vector<LineMatch> matches;
};

/// Tells which detection observes which of the lines of one instant. Not thread-safe.
class LineMatcher {
 public:
  /// `lines` must outlive this and stay unchanged.
  LineMatcher(const std::vector<Line>& lines, const FusionConfig& config);

  /// Matches detections with lines that lie close and run alike. Confirmed lines that fit well come first,
  /// then the better fit: else a long false line would win against the pieces of a true one. No place of a
  /// line is observed by two detections of one frame, because lines that are seen side by side are two. No
  /// sample observes two lines. Only every `stride`-th sample is used.
  std::vector<LineMatch> match(const std::vector<SampledDetection>& detections, std::size_t stride = 1);

  const std::vector<Line>& lines() const { return lines_; }
  const FusionConfig& config() const { return config_; }

 private:
  /// A line that a detection lies beside, with `count` samples from `from` on.
  struct Candidate {
    bool is_first = false;                ///< the line is confirmed and fits well
    double score = 0.0;                   ///< see Found
    std::size_t detection = 0, line = 0;  ///< indices
    std::size_t from = 0, count = 0;      ///< its place in Candidates::samples
  };
  /// The candidates of a frame.
  struct Candidates {
    std::vector<Candidate> all;
    std::vector<SampleMatch> samples;  ///< of all candidates, one after the other
  };
  /// Sums over one detection's samples on one line.
  struct Found {
    double score = 0.0;       ///< grows with the number of samples and their fit
    std::size_t samples = 0;  ///< number of samples
    std::size_t next = 0;     ///< place of the next sample among those of all candidates
  };
  /// A sample that lies on a line.
  struct Hit {
    std::uint32_t line = 0;  ///< index
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
  NearestStations nearest_stations_;
  std::vector<Course> courses_;  ///< of the lines
  std::vector<bool> confirmed_;  ///< by line
  // Scratch for one detection; empty between two of them.
  std::vector<Found> found_;  ///< by line
  std::vector<Hit> hits_;
};

/// Matches the detections, and marks the samples that were matched.
Association associate(LineMatcher& matcher, std::vector<SampledDetection> detections);

}  // namespace laneloom::lines
