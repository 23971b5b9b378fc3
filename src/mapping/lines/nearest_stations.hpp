#pragma once

#include <cstdint>
#include <vector>

#include "mapping/lines/line_map.hpp"

namespace laneloom::lines {

/// The station of a line that is nearest to a point.
struct NearestStation {
  std::uint32_t line = 0;     ///< index
  std::uint32_t station = 0;  ///< index in that line
  double squared_m2 = 0.0;    ///< squared horizontal distance
};

/// Finds the lines that a point may lie on, each with its nearest station. Not thread-safe.
class NearestStations {
 public:
  /// A point lies on a line if its foot (see foot_at()) is no further aside than `gate_m`, or, outside of a
  /// sharp bend, within 2 m. `lines` are copied.
  NearestStations(const std::vector<Line>& lines, double gate_m)
      : NearestStations(lines, gate_m, station_grid(lines)) {}
  /// The same with the grid of their stations.
  NearestStations(const std::vector<Line>& lines, double gate_m, StationGrid grid);

  /// The stoplines, or the other lines, that `point` may lie on, each once, in no meaningful order. Lines on
  /// another level are left out. The reference holds until the next call.
  const std::vector<NearestStation>& around(const Point& point, bool of_stoplines);

 private:
  StationGrid grid_;
  std::vector<bool> is_stopline_;         ///< per line
  std::vector<double> squared_reach_m2_;  ///< per line: greatest of a point from a station
  double furthest_m_ = 0.0;               ///< root of the largest of these
  std::vector<std::uint32_t> slots_;      ///< per line: its place in near_
  std::vector<NearestStation> near_;
};

}  // namespace laneloom::lines
