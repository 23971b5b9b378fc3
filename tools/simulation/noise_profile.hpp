#pragma once

#include <array>
#include <string>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::simulation {

/// An error of a line for part of the time.
struct Defect {
  double share = 0.0;    ///< of the time, 0..1
  double lasting = 0.0;  ///< part of that share which lasts for the whole drive at its place, 0..1
  double dwell_s = 1.0;  ///< mean time that the rest lasts
};

/// The errors of a network's detections. By default there are none. README.md of this folder explains each
/// field.
struct NoiseProfile {
  std::string name = "none";

  // Every line, lateral. Its standard deviation by the distance r from the vehicle is
  // offset_stddev_m + offset_stddev_per_m * r + offset_stddev_far_m * (r / 30 m)^2.
  double offset_stddev_m = 0.0;
  double offset_stddev_per_m = 0.0;
  double offset_stddev_far_m = 0.0;
  double offset_lasting = 0.0;       ///< share of the variance that stays with the place for the whole drive
  double rotation_stddev_deg = 0.0;  ///< about the line's nearest point
  double line_memory_s = 0.0;        ///< correlation time of the rest and of the rotation
  std::array<double, kMarkingTypeCount> error_factor{1.0, 1.0, 1.0};  ///< of all of these, by type
  double flutter_stddev_m = 0.0;  ///< of the line as a whole, independent in every frame
  double point_stddev_m = 0.0;    ///< of every point, independent

  Defect poor;                     ///< a line is far wrong, by an offset that lasts as long
  double poor_stddev_m = 0.0;      ///< of that offset, at the vehicle
  double poor_stddev_per_m = 0.0;  ///< its growth per metre from the vehicle

  // A line's ends.
  double end_swing_stddev_m = 0.0;  ///< lateral, fading over the last `end_reach_m`
  double end_reach_m = 8.0;
  double end_shift_stddev_m = 0.0;  ///< along the line, which is too short or too long
  double end_memory_s = 0.0;

  // The whole frame.
  double frame_yaw_stddev_deg = 0.0;
  double frame_longitudinal_stddev_m = 0.0;
  double frame_lateral_stddev_m = 0.0;
  double frame_pitch_stddev_deg = 0.0;    ///< changes heights
  double frame_scale_stddev_per_m = 0.0;  ///< effect of pitch on flat ground: x and y grow by 1 + s x
  double frame_memory_s = 0.0;

  // Whole lines.
  std::array<double, kMarkingTypeCount> missed_share{};    ///< by marking type
  std::array<double, kMarkingTypeCount> missed_lasting{};  ///< part of that share, as in Defect
  double missed_share_per_m = 0.0;  ///< its growth per metre from the vehicle to the line's nearest point
  double missed_dwell_s = 1.0;
  double dropped_probability = 0.0;  ///< in a single frame
  Defect cut;                        ///< the line is cut into two pieces with a gap
  double cut_gap_m = 3.0;            ///< greatest gap
  Defect duplicate;                  ///< there is a second line beside it
  double duplicate_offset_m = 0.6;   ///< greatest offset; the least is half of it
  Defect swapped;                    ///< a laneline is seen as roadedge, or a roadedge as laneline
  double zigzag_probability = 0.0;   ///< in a single frame
  double zigzag_stddev_m = 0.6;

  // Lines that are not there.
  std::array<double, kMarkingTypeCount> ghost_rate_hz{};  ///< new ones per second, by marking type
  double intersection_ghost_rate_hz = 0.0;                ///< added while an intersection is in view
  double ghost_beside_share = 0.0;                        ///< share of ghosts along a marking, beside it
  double ghost_dwell_s = 0.4;
  double ghost_lasting_share = 0.0;    ///< share of ghosts that stay for `ghost_lasting_dwell_s`
  double ghost_lasting_dwell_s = 8.0;  ///< mean
  double ghost_jitter_m = 0.0;         ///< lateral, independent in every frame

  // Other road users that hide lines.
  double occluder_rate_hz = 0.0;  ///< new ones per second
  double occluder_dwell_s = 3.0;

  // Style and confidence of a line.
  double style_unknown_probability = 0.0;  ///< in a single frame
  Defect style_wrong;
  double confidence = 1.0;              ///< of a flawless line at the vehicle
  double confidence_per_m = 0.0;        ///< loss per metre from the vehicle
  double confidence_per_error_m = 0.0;  ///< loss per metre of the line's own lateral error
  double ghost_confidence = 0.45;       ///< mean of ghosts and duplicates
  double confidence_stddev = 0.0;
  double confidence_held = 0.5;          ///< share of that variance that stays with the line or ghost
  double confidence_memory_s = 30.0;     ///< for about this long
  double frame_confidence_stddev = 0.0;  ///< of all confidences of a frame together, for as long

  // Information on the frame.
  bool tells_view = true;  ///< whether it has a field of view and occluded areas
};

/// The mean time between a ghost's coming and going.
double mean_ghost_life_s(const NoiseProfile& noise);

/// The names none, inhouse, av2 and shaken.
std::vector<std::string> noise_profile_names();

/// The profile of one of these names, or of "random:SEED" (see random_network.hpp). Throws
/// std::invalid_argument listing the known names if the name is unknown.
NoiseProfile noise_profile(const std::string& name);

}  // namespace laneloom::simulation
