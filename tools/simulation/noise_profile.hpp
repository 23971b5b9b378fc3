#pragma once

#include <array>
#include <string>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// How a network's detections differ from the truth. "Share" is the part of the time that a state is on
/// (0..1); "dwell" the mean time that it then lasts. The default is no difference at all.
struct NoiseProfile {
  std::string name = "none";

  // Every line as a whole, lateral. It errs in the same way for as long as it is in view, and for moments far
  // more.
  double offset_stddev_m = 0.0;      ///< at the vehicle
  double offset_stddev_per_m = 0.0;  ///< more, per metre from the vehicle
  double rotation_stddev_deg = 0.0;  ///< about the line's nearest point
  double line_memory_s = 0.0;        ///< correlation time of offset and rotation
  double poor_share = 0.0;
  double poor_dwell_s = 1.0;
  double poor_stddev_m = 0.0;      ///< in such a moment, more, at the vehicle
  double poor_stddev_per_m = 0.0;  ///< per metre from it
  std::array<double, kMarkingTypeCount> error_factor{1.0, 1.0, 1.0};  ///< of offset and rotation, by type
  double flutter_stddev_m = 0.0;  ///< the line as a whole, in every frame for itself

  // A line's ends.
  double end_swing_stddev_m = 0.0;  ///< lateral, fading over the last `end_reach_m`
  double end_reach_m = 8.0;
  double end_shift_stddev_m = 0.0;  ///< along the line: too short or too long
  double end_memory_s = 0.0;

  double point_stddev_m = 0.0;  ///< lateral, every point for itself

  // The whole frame.
  double frame_yaw_stddev_deg = 0.0;
  double frame_pitch_stddev_deg = 0.0;
  double frame_longitudinal_stddev_m = 0.0;
  double frame_memory_s = 0.0;

  // Whole lines.
  std::array<double, kMarkingTypeCount> missed_share{};  ///< by marking type
  double missed_share_per_m = 0.0;  ///< more, per metre from the vehicle to the line's nearest point
  double missed_dwell_s = 1.0;
  double dropped_probability = 0.0;  ///< in a single frame
  double cut_share = 0.0;            ///< two pieces with a gap
  double cut_dwell_s = 1.0;
  double cut_gap_m = 3.0;        ///< at most
  double duplicate_share = 0.0;  ///< a second line beside it
  double duplicate_dwell_s = 1.0;
  double duplicate_offset_m = 0.6;  ///< at most
  double swapped_share = 0.0;       ///< laneline as roadedge, roadedge as laneline
  double swapped_dwell_s = 1.0;
  double zigzag_probability = 0.0;  ///< in a single frame
  double zigzag_stddev_m = 0.6;

  // What is not there.
  std::array<double, kMarkingTypeCount> ghost_rate_hz{};  ///< new ones per second, by marking type
  double intersection_ghost_rate_hz = 0.0;                ///< more, while an intersection is in view
  double ghost_dwell_s = 0.4;

  // Other road users before the line.
  double occluder_rate_hz = 0.0;  ///< new ones per second
  double occluder_dwell_s = 3.0;

  // What is said of a line.
  double style_unknown_probability = 0.0;  ///< in a single frame
  double style_wrong_share = 0.0;
  double style_wrong_dwell_s = 1.0;
  double confidence = 1.0;  ///< of a flawless line at the vehicle
  double confidence_stddev = 0.0;
  double confidence_per_m = 0.0;        ///< less, per metre from the vehicle
  double confidence_per_error_m = 0.0;  ///< less, per metre of the line's own lateral error
  double ghost_confidence = 0.45;       ///< mean, of ghosts and duplicates
};

/// none, inhouse, av2.
std::vector<std::string> noise_profile_names();

/// Throws std::invalid_argument naming the known ones where the name is unknown.
NoiseProfile noise_profile(const std::string& name);

}  // namespace laneloom
