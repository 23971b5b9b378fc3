#pragma once

#include <array>
#include <cstddef>

#include "laneloom/network_profile.hpp"
#include "laneloom/types.hpp"
#include "mapping/lines/line_map.hpp"

namespace laneloom {

/// A mean that is learned from a prior on, which counts as `weight` values. Once it knows as many as it may,
/// it forgets old ones.
struct LearnedMean {
  double mean = 0.0, weight = 0.0;

  void add(double value, double max_weight);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mean, weight);
  }
};

/// What is learned of one network while it is used: how often it sees what is there, and how far its
/// confidences tell right lines from wrong ones. Only evidence that does not depend on confidences says which
/// lines are right or wrong, so that no belief in confidences confirms itself. Ours.
class DetectionModel {
 public:
  /// What `profile` knows stands in place of what is taken of networks in general.
  explicit DetectionModel(const NetworkProfile& profile = {});
  /// What was learned, as the constructor takes it.
  NetworkProfile profile() const;

  /// Whether a frame saw a place on an established line.
  void learn_rate(MarkingType type, const Point& point_body, bool seen);
  /// Share of the frames in which the network sees a place on a line that is there.
  double rate(MarkingType type, const Point& point_body) const;

  /// The confidence of a detection of an established line, from `range_m` away.
  void learn_confidence(MarkingType type, double range_m, double confidence);
  /// Whether enough were learned to compare others with.
  bool knows_confidences() const;
  /// How far a confidence lies above what established lines have there.
  double surplus(MarkingType type, double range_m, double confidence) const;

  /// The confidences of an established line, of a line that turned out not to be there.
  void learn_right(const Confidences& confidences);
  void learn_wrong(MarkingType type, const Confidences& confidences);
  /// What a line's confidences say of its existence, as log odds.
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

  /// Of the mean of so many confidences of a right line.
  double variance_of_mean(double count) const;

  ByTypeAnd<2 * kRings> rates_;  ///< by range, ahead and behind
  LearnedMean level_;            ///< of the confidences of established lines
  ByTypeAnd<kRanges> levels_;    ///< likewise, by range
  LearnedMean variance_;         ///< of single confidences of a right line
  LearnedMean lasting_;          ///< share of it that all confidences of a line have in common
  std::array<LearnedMean, kMarkingTypeCount> deficits_;  ///< of wrong lines against right ones
};

}  // namespace laneloom
