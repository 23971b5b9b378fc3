#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/lines/association.hpp"
#include "mapping/lines/frame_alignment.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/networks.hpp"

namespace laneloom {

/// From where a frame was seen, by which network, and what is known of its error.
struct Viewpoint {
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::uint32_t source = 0;               ///< number of the network
  double correlation_m = 1.0;             ///< of its errors
  double stretch_per_m = 0.0;             ///< suspected of this frame, see estimate_stretch_per_m()
  double pitch_gain = 0.0;                ///< how much of that was taken out
  FrameError error = FrameError::Zero();  ///< suspected of the frame's pose
  double alignment_gain = 0.0;            ///< how much of that was taken out
};

/// What a frame says of a station.
struct Observation {
  std::size_t station = 0;
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  ///< of the line there
  double lateral_m = 0.0, height_m = 0.0, stddev_m = 0.0;
};

/// Gives every sample its deviation, unless its network did.
void weigh(const NetworkModel& network, const Point& origin, std::vector<SampledDetection>& detections);

Station new_station(const Point& position, const Point& origin, const SampledDetection& detection,
                    std::size_t sample, double log_odds);

/// Moves a station as far towards what was seen as that is worth.
void observe(const Observation& seen, const Viewpoint& from, Station& station);

/// Remembers what was seen from far. What is seen from near tells the networks how wrong they were from far.
void learn(const Observation& seen, const Viewpoint& from, Station& station, Networks& networks);

}  // namespace laneloom
