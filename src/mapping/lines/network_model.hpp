#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "laneloom/config.hpp"
#include "laneloom/network_profile.hpp"

namespace laneloom::lines {

/// Errors that are suspected of a whole frame.
enum Suspicion : std::uint8_t {
  kSuddenPitch,   ///< how the pitch differs from that of the frames before
  kLastingPitch,  ///< the pitch of the frames before
  kPose
};
/// A value for each suspicion.
using PerSuspicion = Eigen::Vector3d;

/// A view of a place from far, kept until the place is seen from near.
struct FarView {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t source = kNone;  ///< number of the network
  double range_m = 0.0;          ///< from the vehicle to the place
  double lateral_m = 0.0;        ///< to the left of where the station was made
  /// Parts of it that are suspected to be errors of the frame.
  PerSuspicion suspected_m = PerSuspicion::Zero();

  /// Lets left be right, for a line that runs the other way.
  void mirror() {
    lateral_m = -lateral_m;
    suspected_m = -suspected_m;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(source, range_m, lateral_m, suspected_m);
  }
};

/// The shares of suspected errors that proved true: a regression through 0 for each suspicion.
class Gains {
 public:
  /// The shares, 0..1. They are 0 at first.
  PerSuspicion values() const;
  /// Sums of the squares of the suspected errors.
  const PerSuspicion& evidence() const { return evidence_; }
  /// Starts with a share (`value`) and the evidence for it (`weight`) that are known already.
  void start_with(Suspicion suspicion, const LearnedValue& known);
  /// Learns from suspected and proved errors. Both are in standard deviations of a view.
  void learn(const PerSuspicion& suspected, const PerSuspicion& proved);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(evidence_, effect_);
  }

 private:
  PerSuspicion evidence_ = PerSuspicion::Zero(), effect_ = PerSuspicion::Zero();
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
  /// Shares of a frame's suspected errors that are to be taken out, 0..1.
  PerSuspicion gains() const { return gains_.values(); }

  /// Learns from a view whose place has proved, from near, to lie at `near_m`, in the terms of
  /// FarView::lateral_m.
  void learn(const FarView& view, double near_m);

  /// The values that were learned, in the form that the constructor takes.
  NetworkProfile profile() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(views_, squares_m2_, gains_);
  }

 private:
  // Sums over views; older views count less.
  std::array<double, kNodes_m.size()> views_{}, squares_m2_{};  ///< at each range
  Gains gains_;
};

}  // namespace laneloom::lines
