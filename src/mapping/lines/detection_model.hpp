#pragma once

#include <array>
#include <cstddef>

#include "laneloom/network_profile.hpp"
#include "laneloom/types.hpp"

namespace laneloom::lines {

/// The mean belief in detections of lines that are there.
constexpr double kUsualBelief = 0.6;

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

/// Learns of one network, while it is used, how often it sees lines that are there, and how high its
/// confidences of them are. Ours.
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

  /// Learns from the confidence of a detection of an established line.
  void learn_confidence(double confidence);
  /// Whether enough confidences were learned to compare others with.
  bool knows_confidences() const;
  /// A confidence on a scale that all networks share, where established lines have kUsualBelief in the mean:
  /// 0..1.
  double belief(double confidence) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rates_, confidence_);
  }

 private:
  static constexpr std::size_t kRings = 6;

  /// Calls `visit(name, mean)` for each value that is learned, of a model that may be const.
  static void each(auto& model, const auto& visit);

  /// Rates of detection by type, by range ahead and then by range behind.
  std::array<std::array<LearnedMean, 2 * kRings>, kMarkingTypeCount> rates_;
  LearnedMean confidence_;  ///< mean confidence of established lines
};

}  // namespace laneloom::lines
