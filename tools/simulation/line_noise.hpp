#pragma once

#include <vector>

#include "simulation/noise_profile.hpp"
#include "simulation/places.hpp"
#include "simulation/random.hpp"
#include "simulation/sensor_view.hpp"

namespace laneloom::simulation {

/// The errors of the detections of one line, over the frames in which it is in view. Errors that last longer
/// are the line's `Places`.
class LineNoise {
 public:
  struct Seen {
    Detection detection;  ///< its confidence may be beyond 0..1
    bool of_line = true;  ///< false: it is a duplicate
  };

  /// The line's share of missed frames depends on its type and distance.
  LineNoise(const NoiseProfile& noise, MarkingType type, double distance_m, Random& random);
  void step(double dt_s, const NoiseProfile& noise, double distance_m, Random& random);

  /// Whether the line is missed for a while. Places tell where it is missed for the whole drive.
  bool missed() const { return missed_.on(); }

  /// The detections of a piece of the line: one or two lines, and perhaps a duplicate.
  std::vector<Seen> detect(const VisiblePiece& truth, MarkingStyle style, const NoiseProfile& noise,
                           const Places& places, Random& random) const;

 private:
  class DefectState {
   public:
    DefectState(const Defect& defect, Trait trait, Random& random);
    void step(double dt_s, const Defect& defect, Random& random);
    bool lasts(const Defect& defect, const Places& places, double arc_m) const;
    bool on(const Defect& defect, const Places& places, double arc_m) const;

   private:
    Trait trait_;
    Switch moment_;
  };

  double offset_m(double range_m, double arc_m, const NoiseProfile& noise, const Places& places) const;
  double missed_share(const NoiseProfile& noise, double distance_m) const;
  Polyline displaced(const VisiblePiece& truth, const NoiseProfile& noise, const Places& places,
                     Random& random) const;
  Polyline with_shifted_ends(const Polyline& line, const NoiseProfile& noise) const;

  MarkingType type_;
  Wander offset_, rotation_, first_swing_, last_swing_, first_shift_, last_shift_, confidence_, poor_offset_;
  Switch missed_;
  DefectState poor_, cut_, duplicated_, swapped_, wrong_style_;
  double cut_at_, cut_gap_;  // drawn once: shares of the length and of the profile's maximum
};

/// Points along a line as a network gives them: about twenty.
Polyline as_network_output(const Polyline& line);

/// Shifts every other point of a line sideways.
void make_zigzag(Polyline& line, double stddev_m, Random& random);

/// Shifts a line to its left.
void shift_left(Polyline& line, double left_m);

/// The error of a confidence. `held` is the part of it that stays with the line for a while.
double confidence_error(const NoiseProfile& noise, const Wander& held, Random& random);

}  // namespace laneloom::simulation
