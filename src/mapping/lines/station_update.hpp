#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mapping/lines/association.hpp"
#include "mapping/lines/frame_alignment.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/lines/networks.hpp"

namespace laneloom::lines {

/// The viewpoint of a frame: its pose and network, and the errors that are suspected of it.
struct Viewpoint {
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::int64_t stamp_ns = 0;
  std::uint32_t source = 0;                   ///< number of the network
  double news = 1.0;                          ///< weight of its evidence, 0..1; 1 is an independent view
  PitchParts stretch;                         ///< suspected of this frame, see estimate_stretch_per_m()
  FrameError error = FrameError::Zero();      ///< suspected of the frame's pose, without the lasting part
  PerSuspicion gains = PerSuspicion::Zero();  ///< shares of these that were taken out
};

/// The observation of a station by a frame. Lateral and height are those of the detection, from the station.
struct Observation {
  std::size_t station = 0;                                 ///< index in its line
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();    ///< of the line there
  double lateral_m = 0.0, height_m = 0.0, stddev_m = 0.0;  ///< lateral is left of the line
};

/// Sets the deviation of every sample, unless its network gave it.
void weigh(const NetworkModel& network, const Point& origin, std::vector<SampledDetection>& detections);

Station new_station(const Point& position, const Viewpoint& from, const SampledDetection& detection,
                    std::size_t sample, double log_odds);

/// Moves a station towards an observation, as far as its deviation warrants.
void observe(const Observation& seen, const Viewpoint& from, Station& station);

/// Remembers a view from far. A view from near tells the networks how wrong their far views were.
void learn(const Observation& seen, const Viewpoint& from, Station& station, Networks& networks);

}  // namespace laneloom::lines
