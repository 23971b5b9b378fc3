#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/distribution.hpp"
#include "evaluation/evaluation.hpp"
#include "laneloom/polyline.hpp"

/// Whether a map's own statements on its certainty can be believed, and how soon it has a line.
///
/// - Within 2 sigma: of the vertices of true positives that give a lateral standard deviation, lie in range
///   and beside the truth line (not beyond its ends), the share that is not farther from it than twice that.
///   95.4 % where errors are normal and their size is known.
/// - Calibration of confidence (existence probability; of single detections, the network's): in ten bins of
///   equal width, the mean confidence and the share of true positives. Expected calibration error (Naeini et
///   al. 2015): the mean of their difference, weighted by the bins' counts. Every line in range counts once
///   per frame and piece; lines without a confidence do not.
/// - First appearance: of each truth line, time and distance driven from the first frame in which it is in
///   range to the first in which it is right.
namespace laneloom::evaluation {

inline constexpr std::size_t kCalibrationBins = 10;

/// The lines whose confidence is in one interval.
struct CalibrationBin {
  std::size_t count = 0;
  double confidences = 0.0;  ///< summed
  std::size_t right = 0;

  double confidence() const { return count == 0 ? 0.0 : confidences / static_cast<double>(count); }
  double precision() const {
    return count == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(count);
  }
};

/// The counts and distributions behind the figures explained above.
struct Trust {
  std::size_t vertices = 0;  ///< with a standard deviation
  std::size_t vertices_within_2_sigma = 0;
  std::array<CalibrationBin, kCalibrationBins> calibration;
  Distribution first_appearance_s, first_appearance_m;
  std::size_t never_appeared = 0;  ///< truth lines that were in range and never right

  bool has_confidences() const;
  double within_2_sigma() const;              ///< 0..1
  double expected_calibration_error() const;  ///< 0..1
};

/// Not thread-safe.
class TrustMeter {
 public:
  TrustMeter(const std::vector<KindLine>& truth, const RangeConfig& range);
  void add(const FrameComparison& frame, const std::vector<KindLine>& predictions);
  /// The trust of the markings, or of the lanes.
  Trust markings() const { return with_never_appeared(markings_, false); }
  Trust lanes() const { return with_never_appeared(lanes_, true); }

 private:
  struct TruthState {
    MeasuredPolyline line;
    bool is_lane = false;
    bool right = false;
    std::optional<std::int64_t> in_range_since_ns;
    double in_range_since_m = 0.0;
  };
  void add_vertices(const KindLine& prediction, const MeasuredPolyline& truth,
                    const Eigen::Isometry3d& T_body_map, Trust& trust) const;
  void add_appearance(const TruthOutcome& outcome, std::int64_t stamp_ns, Trust& trust);
  Trust with_never_appeared(Trust trust, bool lanes) const;

  RangeConfig range_;
  std::vector<TruthState> truths_;
  std::optional<Point> position_;  ///< of the vehicle in the frame before
  double driven_m_ = 0.0;
  Trust markings_, lanes_;
};

}  // namespace laneloom::evaluation
