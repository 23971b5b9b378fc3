#pragma once

#include <array>
#include <map>
#include <vector>

#include "evaluation/evaluation.hpp"

/// Chamfer AP as MapTR, VectorMapNet and StreamMapNet report it, and the consistency-aware C-mAP of
/// MapTracker (Chen et al. 2024, Sec. 5; https://github.com/woodfrog/maptracker, tools/tracking).
///
/// - Distance of two lines: both resampled to 100 points; the mean distance of a line's points to the other's
///   nearest point, averaged over the two directions.
/// - A frame's predictions of a kind go by descending confidence (then in the order given). Each is compared
///   with the nearest truth line only: it is a true positive if that is not farther than the threshold and no
///   earlier prediction took it, else a false positive.
/// - AP is the area under the precision-recall curve of all frames' predictions by descending confidence,
///   precision made monotonic. A line without a confidence has 1.
/// - C-mAP: the first true positive of a truth line gives it its id; a later one with another id is a false
///   positive. Only lines with ids can be rated so.
/// Lines are clipped to the range box first, as for precision and recall.
namespace laneloom::evaluation {

inline constexpr std::array kApThresholds_m{0.5, 1.0, 1.5};

/// The mean of both directions, horizontal. Both lines must have equally many points.
double chamfer_distance_m(const Polyline& a, const Polyline& b);

/// A prediction, rated.
struct RatedLine {
  double confidence = 0.0;
  bool right = false;
};

/// The average precision, 0..1; 0 if there are no truths.
double average_precision(std::vector<RatedLine> lines, std::size_t truths);

/// Not thread-safe.
class AveragePrecisionMeter {
 public:
  void add(const FrameComparison& frame, const std::vector<KindLine>& predictions);
  /// Adds the ratings of another drive.
  void add(const AveragePrecisionMeter& other);
  std::size_t truths(LineKind kind) const { return kinds_[index(kind)].truths; }
  bool has_ids() const { return has_ids_; }
  double ap(LineKind kind, std::size_t threshold) const;    ///< index into kApThresholds_m
  double c_ap(LineKind kind, std::size_t threshold) const;  ///< likewise, with consistent ids
  /// Mean over thresholds, and over the kinds of markings that have truths.
  double map() const { return mean_over_markings(&AveragePrecisionMeter::ap); }
  double c_map() const { return mean_over_markings(&AveragePrecisionMeter::c_ap); }

 private:
  struct ThresholdState {
    std::vector<RatedLine> rated, consistent;
    std::map<std::size_t, ElementId> id_of_truth;
  };
  struct KindState {
    std::size_t truths = 0;
    std::array<ThresholdState, kApThresholds_m.size()> thresholds;
  };
  void add_kind(const KindComparison& comparison, const std::vector<KindLine>& predictions, KindState& state);
  double mean_over_markings(double (AveragePrecisionMeter::*measure)(LineKind, std::size_t) const) const;

  std::array<KindState, kLineKindCount> kinds_;
  bool has_ids_ = false;
};

}  // namespace laneloom::evaluation
