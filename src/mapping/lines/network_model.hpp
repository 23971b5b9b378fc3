#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "laneloom/config.hpp"
#include "laneloom/network_profile.hpp"

namespace laneloom::lines {

/// A view of a place from far, kept until the place is seen from near.
struct FarView {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t source = kNone;  ///< number of the network
  double range_m = 0.0;          ///< from the vehicle to the place
  double lateral_m = 0.0;        ///< to the left of where the station was made
  double stretched_m = 0.0;      ///< part of it that is suspected to come from the frame's pitch
  double misplaced_m = 0.0;      ///< part of it that is suspected to come from the frame's pose

  /// Lets left be right, for a line that runs the other way.
  void mirror() {
    lateral_m = -lateral_m;
    stretched_m = -stretched_m;
    misplaced_m = -misplaced_m;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, range_m, lateral_m, stretched_m, misplaced_m);
  }
};

/// The share of suspected errors that proved true: a regression through 0.
class Gain {
 public:
  /// The share, 0..1. It is 0 at first.
  double value() const;
  /// Sum of the squares of the suspected errors.
  double evidence() const { return evidence_; }
  /// Starts with a share (`value`) and the evidence for it (`weight`) that are known already.
  void start_with(const LearnedValue& known);
  /// Learns from a suspected and a proved error. Both are in standard deviations of a view.
  void learn(double suspected, double proved);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(evidence_, effect_);
  }

 private:
  double evidence_ = 0.0, effect_ = 0.0;
};

/// Learns how one network errs in the lateral place of lines. Every place that is seen from far is seen again
/// from near, which tells how wrong the far view was. From that it learns the standard deviation by range,
/// and how much is true of the pitch and the pose errors that are suspected of whole frames.
class NetworkModel {
 public:
  /// Ranges at which the standard deviation is learned.
  static constexpr std::array<double, 6> kNodes_m{8.0, 12.0, 18.0, 26.0, 36.0, 48.0};

  NetworkModel() = default;
  /// Starts with the deviations of the configuration and gains of 0. Values in `profile` replace them.
  explicit NetworkModel(const FusionConfig& config, const NetworkProfile& profile = {});

  /// Lateral standard deviation of a sample that is seen from `range_m` away.
  double stddev_m(double range_m) const;
  /// Share of a frame's suspected pitch that is to be taken out, 0..1.
  double pitch_gain() const { return pitch_.value(); }
  /// Share of a frame's suspected pose error that is to be taken out, 0..1.
  double alignment_gain() const { return alignment_.value(); }

  /// Learns from a view whose place has proved, from near, to lie at `near_m`, in the terms of
  /// FarView::lateral_m.
  void learn(const FarView& view, double near_m);

  /// The values that were learned, in the form that the constructor takes.
  NetworkProfile profile() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(views_, squares_m2_, pitch_, alignment_);
  }

 private:
  // Sums over views; older views count less.
  std::array<double, kNodes_m.size()> views_{}, squares_m2_{};  ///< at each range
  Gain pitch_, alignment_;
};

}  // namespace laneloom::lines
