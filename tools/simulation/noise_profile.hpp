#pragma once

#include <array>
#include <string>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// Something that is wrong with a line for part of the time.
struct Defect {
  double share = 0.0;    ///< of the time, 0..1
  double lasting = 0.0;  ///< of that share: for the whole drive at its place, 0..1
  double dwell_s = 1.0;  ///< the rest: mean time that it lasts
};

/// How a network's detections differ from the truth. The default is no difference at all. What each field
/// does is in README.md of this folder.
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
  double flutter_stddev_m = 0.0;  ///< the line as a whole, in every frame for itself
  double point_stddev_m = 0.0;    ///< every point for itself

  Defect poor;                     ///< far wrong, by an offset that lasts as long
  double poor_stddev_m = 0.0;      ///< at the vehicle
  double poor_stddev_per_m = 0.0;  ///< more, per metre from it

  // A line's ends.
  double end_swing_stddev_m = 0.0;  ///< lateral, fading over the last `end_reach_m`
  double end_reach_m = 8.0;
  double end_shift_stddev_m = 0.0;  ///< along the line: too short or too long
  double end_memory_s = 0.0;

  // The whole frame.
  double frame_yaw_stddev_deg = 0.0;
  double frame_longitudinal_stddev_m = 0.0;
  double frame_lateral_stddev_m = 0.0;
  double frame_pitch_stddev_deg = 0.0;    ///< heights
  double frame_scale_stddev_per_m = 0.0;  ///< what pitch does on the ground: x and y grow by 1 + s x
  double frame_memory_s = 0.0;

  // Whole lines.
  std::array<double, kMarkingTypeCount> missed_share{};    ///< by marking type
  std::array<double, kMarkingTypeCount> missed_lasting{};  ///< of that share, as in Defect
  double missed_share_per_m = 0.0;  ///< more, per metre from the vehicle to the line's nearest point
  double missed_dwell_s = 1.0;
  double dropped_probability = 0.0;  ///< in a single frame
  Defect cut;                        ///< two pieces with a gap
  double cut_gap_m = 3.0;            ///< at most
  Defect duplicate;                  ///< a second line beside it
  double duplicate_offset_m = 0.6;   ///< at most, and half of it at least
  Defect swapped;                    ///< laneline as roadedge, roadedge as laneline
  double zigzag_probability = 0.0;   ///< in a single frame
  double zigzag_stddev_m = 0.6;

  // What is not there.
  std::array<double, kMarkingTypeCount> ghost_rate_hz{};  ///< new ones per second, by marking type
  double intersection_ghost_rate_hz = 0.0;                ///< more, while an intersection is in view
  double ghost_beside_share = 0.0;                        ///< of them, along a marking beside it
  double ghost_dwell_s = 0.4;
  double ghost_lasting_share = 0.0;    ///< of them, they stay for `ghost_lasting_dwell_s`
  double ghost_lasting_dwell_s = 8.0;  ///< mean
  double ghost_jitter_m = 0.0;         ///< lateral, in every frame for itself

  // Other road users before the line.
  double occluder_rate_hz = 0.0;  ///< new ones per second
  double occluder_dwell_s = 3.0;

  // What is said of a line.
  double style_unknown_probability = 0.0;  ///< in a single frame
  Defect style_wrong;
  double confidence = 1.0;              ///< of a flawless line at the vehicle
  double confidence_per_m = 0.0;        ///< less, per metre from the vehicle
  double confidence_per_error_m = 0.0;  ///< less, per metre of the line's own lateral error
  double ghost_confidence = 0.45;       ///< mean, of ghosts and duplicates
  double confidence_stddev = 0.0;
  double confidence_held = 0.5;          ///< share of that variance that stays with the line, or the ghost,
  double confidence_memory_s = 30.0;     ///< for about so long
  double frame_confidence_stddev = 0.0;  ///< of all confidences of a frame together, for as long

  // What is said of the frame.
  bool tells_view = true;  ///< field of view and occluded areas
};

/// Between a ghost's coming and going.
double mean_ghost_life_s(const NoiseProfile& noise);

/// none, inhouse, av2, shaken.
std::vector<std::string> noise_profile_names();

/// One of these, or "random:SEED" (see random_network.hpp). Throws std::invalid_argument naming the known
/// ones where the name is unknown.
NoiseProfile noise_profile(const std::string& name);

}  // namespace laneloom
