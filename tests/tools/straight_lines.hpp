#pragma once

#include "evaluation/evaluation.hpp"
#include "laneloom/config.hpp"

namespace laneloom {

inline const RangeConfig kRange;  ///< -5..30 m, +-15 m

inline evaluation::KindLine straight(double y, double from_x, double to_x,
                                     evaluation::LineKind kind = evaluation::LineKind::laneline) {
  return {.kind = kind, .points = {{from_x, y, 0.0}, {to_x, y, 0.0}}};
}

}  // namespace laneloom
