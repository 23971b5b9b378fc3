#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom::markings {

/// The result of a method of fusion after a frame.
struct FusedMarkings {
  std::vector<Marking> markings;    ///< the map's markings, from all frames so far
  PairHistories joints;             ///< how ends of markings that lie near each other were seen
  std::vector<Relative> relatives;  ///< markings that merged or were split in this frame
  std::size_t unsure = 0;           ///< number of the frame's detections that drop_unsure() dropped
};

}  // namespace laneloom::markings
