#pragma once

#include <vector>

#include "laneloom/types.hpp"
#include "mapping/markings/pair_history.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom {

/// What a method of fusion makes of all frames so far.
struct FusedMarkings {
  std::vector<Marking> markings;
  PairHistories joints;             ///< of ends of markings that lie near each other
  std::vector<Relative> relatives;  ///< what became of markings in this frame
};

}  // namespace laneloom
