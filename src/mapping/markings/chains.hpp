#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::markings {

/// One end of a line, by the number of the line.
struct LineEnd {
  std::size_t line = 0;
  End end = End::front;
};

/// Two ends of two lines that may be one line.
struct Join {
  double gap_m = 0.0;  ///< between the two ends
  LineEnd a, b;
};

/// A line of a chain. `reversed`: the chain runs through it from its last point to its first.
struct Link {
  std::size_t line = 0;
  bool reversed = false;
};

/// Joins the nearest ends first, each end once, so that no chain closes on itself. Returns chains that hold
/// each of `count` lines once. A chain runs as its line of the lowest number does.
std::vector<std::vector<Link>> chains(std::vector<Join> joins, std::size_t count);

}  // namespace laneloom::markings
