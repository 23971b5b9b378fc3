#pragma once

#include <cstdint>
#include <vector>

#include "mapping/lines/line_map.hpp"

namespace laneloom {

/// The station of a line that is nearest to a point.
struct NearestStation {
  std::uint32_t line = 0;
  std::uint32_t station = 0;
  double squared_m2 = 0.0;  ///< the distance, squared
};

/// Finds for a point the lines that it may lie on, each with its nearest station. Not thread-safe.
class NearestStations {
 public:
  /// Of all stoplines, or of all other lines. A point is on a line where its foot (see foot_at) is no further
  /// aside than `gate_m`; outside of a sharp bend, within 2 m of it. `lines` are not needed later on.
  NearestStations(const std::vector<Line>& lines, bool of_stoplines, double gate_m);

  /// Leaves out what lies on another level, and lines that the point is too far from to lie on. Each line
  /// once, in no meaningful order; good until the next call.
  const std::vector<NearestStation>& around(const Point& point);

 private:
  StationGrid grid_;
  std::vector<double> squared_reach_m2_;  ///< by line, as far as slots_
  double furthest_m_ = 0.0;               ///< of these, its root
  std::vector<std::uint32_t> slots_;      ///< by line: where in near_ it is
  std::vector<NearestStation> near_;
};

}  // namespace laneloom
