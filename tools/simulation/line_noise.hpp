#pragma once

#include <vector>

#include "simulation/noise_profile.hpp"
#include "simulation/random.hpp"

namespace laneloom {

/// What is wrong with the detections of one line, over the frames in which it is in view.
class LineNoise {
 public:
  /// The line's share of missed frames depends on its type and distance.
  LineNoise(const NoiseProfile& noise, MarkingType type, double distance_m, Random& random);
  void step(double dt_s, const NoiseProfile& noise, double distance_m, Random& random);

  bool missed() const { return missed_.on(); }

  /// A line in the body frame as it is detected now: one or two lines, and perhaps a duplicate. No confidence
  /// is above 1 or below 0.
  std::vector<Detection> detect(const Polyline& truth, MarkingStyle style, const NoiseProfile& noise,
                                Random& random) const;

 private:
  double offset_m(double range_m, const NoiseProfile& noise) const;
  double missed_share(const NoiseProfile& noise, double distance_m) const;
  Polyline displaced(const Polyline& truth, const NoiseProfile& noise, Random& random) const;
  Polyline with_shifted_ends(const Polyline& line, const NoiseProfile& noise) const;
  double confidence(const Polyline& line, const NoiseProfile& noise, Random& random) const;

  MarkingType type_;
  Wander offset_, rotation_, first_swing_, last_swing_, first_shift_, last_shift_, confidence_, poor_offset_;
  Switch missed_, poor_, cut_, duplicated_, swapped_, wrong_style_;
  double cut_at_, cut_gap_,
      duplicate_offset_;  // drawn once: shares of the length and of the profile's maxima
};

/// Points along a line as a network gives them: about twenty.
Polyline as_network_output(const Polyline& line);

/// Shifts every other point of a line sideways.
void make_zigzag(Polyline& line, double stddev_m, Random& random);

}  // namespace laneloom
