#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// One end of a line, by the number of the line.
struct LineEnd {
  std::size_t line = 0;
  End end = End::front;
};

/// Two ends of two lines that may be one line.
struct Join {
  double gap_m = 0.0;
  LineEnd a, b;
};

/// A line of a chain, run through backwards or not.
struct Link {
  std::size_t line = 0;
  bool reversed = false;
};

/// Joins the nearest ends first, each end once, so that no chain closes on itself. Returns each of `count`
/// lines in one chain, which begins with its first line as that runs, unless something is joined to the front
/// of it.
std::vector<std::vector<Link>> chains(std::vector<Join> joins, std::size_t count);

}  // namespace laneloom
