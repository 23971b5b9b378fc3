#pragma once

#include <cstdint>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// A lane that was published, for recognising it.
struct KnownLane {
  ElementId id = kNoElement;
  ElementId boundary_a = kNoElement;  ///< the smaller of the two
  ElementId boundary_b = kNoElement;
  Polyline centerline;
  std::uint64_t last_frame = 0;
  double direction_log_odds = 0.0;  ///< evidence that traffic runs along the centerline
  int kept_direction = 0;           ///< 1: it is sure to, -1: it is sure to run against it
  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, boundary_a, boundary_b, centerline, last_frame, direction_log_odds, kept_direction);
  }
};

/// Gives every lane the id of the known lane that it covers most of, a lane of the same boundaries first;
/// else a new one. The known lane then is as the lane now is. Lanes that were not seen for a while are
/// forgotten.
void identify_lanes(std::uint64_t frame, const LaneConfig& config, std::vector<Lane>& lanes,
                    std::vector<KnownLane>& known, ElementId& next_id);

}  // namespace laneloom
