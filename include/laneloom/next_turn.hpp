#pragma once

#include <cstdint>

#include "laneloom/elements.hpp"

namespace laneloom {

/// The next turn of the vehicle's route, as plain data; idl/NextTurn.idl says what each field means.
struct NextTurn {
  std::int64_t stamp_ns = 0;                    ///< sensor clock
  std::uint64_t sequence = 0;                   ///< counts up by one per message of the writer
  std::uint64_t session_id = 0;                 ///< of the writer's run
  Linkage::Turn turn = Linkage::Turn::unknown;  ///< neither left nor right: the way leads straight on
  /// Along the road, from the vehicle at the stamp to the middle of the intersection.
  double distance_m = 0.0;
};

}  // namespace laneloom
