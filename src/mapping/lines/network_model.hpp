#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "laneloom/config.hpp"
#include "laneloom/network_profile.hpp"

namespace laneloom {

/// What was said of a place from far, until it is seen from near.
struct FarView {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t source = kNone;  ///< its number among the networks
  double range_m = 0.0;          ///< from where
  double lateral_m = 0.0;        ///< to the left of a mark that stays
  double stretched_m = 0.0;      ///< of these, how far the frame's pitch is suspected to have moved it
  double misplaced_m = 0.0;      ///< likewise the frame's pose

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, range_m, lateral_m, stretched_m, misplaced_m);
  }
};

/// How much of what was suspected has proved true: a regression through 0.
class Gain {
 public:
  /// 0 to 1; at first 0.
  double value() const;
  /// How many squared deviations were suspected.
  double evidence() const { return evidence_; }
  /// Of so many, such a share is taken to have come true.
  void start_with(const LearnedValue& known);
  /// Both in standard deviations of what else moves the proof.
  void learn(double suspected, double proved);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(evidence_, effect_);
  }

 private:
  double evidence_ = 0.0, effect_ = 0.0;
};

/// What the detections of one network have proved to be worth. Every place that is seen from far is seen
/// again from near, which tells how wrong it was from far. From that is learned the standard deviation by
/// range, over which distance driven an error becomes another one, and how much is true of what whole frames
/// are suspected of: a wrong pitch, a wrong pose.
class NetworkModel {
 public:
  /// Share of a view's variance that fades; the rest is new in every frame.
  static constexpr double kShared = 0.9;
  static constexpr std::array<double, 6> kNodes_m{8.0, 12.0, 18.0, 26.0, 36.0, 48.0};

  NetworkModel() = default;
  /// Before anything is learned: the deviations of the configuration, and no pitch is believed. What
  /// `profile` knows stands in their place.
  explicit NetworkModel(const FusionConfig& config, const NetworkProfile& profile = {});

  /// Lateral standard deviation of a sample from so far away.
  double stddev_m(double range_m) const;
  /// Distance driven in which the correlation of the errors falls to 1/e.
  double correlation_m() const;
  /// Which share of a frame's suspected pitch is to be taken out: 0 to 1.
  double pitch_gain() const { return pitch_.value(); }
  /// Likewise of a frame's suspected error of the pose.
  double alignment_gain() const { return alignment_.value(); }

  /// From near, the place of a view has proved to be at `near_m`.
  void learn(const FarView& view, double near_m);
  /// Likewise the place of two views, of which one is the next after the other.
  void learn(const FarView& one, const FarView& other, double near_m);

  /// What was learned, as the constructor takes it.
  NetworkProfile profile() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(views_, squares_m2_, pairs_, products_, distances_m_, pitch_, alignment_);
  }

 private:
  double error_m(const FarView& view, double near_m) const;

  // Sums of what was seen, older views counting less.
  std::array<double, kNodes_m.size()> views_{}, squares_m2_{};  ///< at each range
  double pairs_ = 0.0, products_ = 0.0,
         distances_m_ = 0.0;  ///< of errors in deviations, and between the views
  Gain pitch_, alignment_;
};

}  // namespace laneloom
