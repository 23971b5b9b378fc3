#pragma once

#include <array>
#include <cstddef>

#include "laneloom/network_profile.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom::lines {

/// A mean that is learned. It starts from a prior, which counts as `weight` values. Once it has `max_weight`
/// values, old ones are forgotten gradually.
struct LearnedMean {
  double mean = 0.0, weight = 0.0;

  void add(double value, double max_weight);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mean, weight);
  }
};

/// Learns of one network, while it is used, how often it sees lines that are there, and how far its
/// confidences tell right lines from wrong ones. Only evidence that does not depend on confidences says which
/// lines are right or wrong, so that no belief in confidences confirms itself. Ours.
class DetectionModel {
 public:
  /// Values in `profile` replace the priors, which hold for networks in general.
  explicit DetectionModel(const NetworkProfile& profile = {});
  /// The values that were learned, in the form that the constructor takes.
  NetworkProfile profile() const;

  /// Learns from one place on an established line, which a frame saw or missed.
  void learn_rate(MarkingType type, const Point& point_body, bool seen);
  /// The share of frames in which the network sees a place on a line that is there, 0..1.
  double rate(MarkingType type, const Point& point_body) const;

  /// Learns from the confidence of a detection of an established line, seen from `range_m` away.
  void learn_confidence(MarkingType type, double range_m, double confidence);
  /// Whether enough confidences were learned to compare others with.
  bool knows_confidences() const;
  /// How far a confidence lies above those of established lines at the same range.
  double surplus(MarkingType type, double range_m, double confidence) const;

  /// Learns from the confidences of an established line, or of a line that turned out not to be there.
  void learn_right(const Confidences& confidences);
  void learn_wrong(MarkingType type, const Confidences& confidences);
  /// The log odds that a line exists, by its confidences alone.
  double log_odds(MarkingType type, const Confidences& confidences) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rates_, level_, levels_, variance_, lasting_, deficits_);
  }

 private:
  static constexpr std::size_t kRings = 6, kRanges = 4;
  template <std::size_t Count>
  using ByTypeAnd = std::array<std::array<LearnedMean, Count>, kMarkingTypeCount>;

  /// Calls `visit(name, mean)` for each value that is learned, of a model that may be const.
  static void each(auto& model, const auto& visit);

  /// Variance of the mean of `count` confidences of a right line.
  double variance_of_mean(double count) const;

  ByTypeAnd<2 * kRings> rates_;  ///< rates of detection, by range ahead and then by range behind
  LearnedMean level_;            ///< mean confidence of established lines
  ByTypeAnd<kRanges> levels_;    ///< likewise, by type and range
  LearnedMean variance_;         ///< of single confidences of right lines
  LearnedMean lasting_;          ///< share of that variance which all confidences of a line have in common
  std::array<LearnedMean, kMarkingTypeCount> deficits_;  ///< by how much wrong lines are less confident
};

}  // namespace laneloom::lines
