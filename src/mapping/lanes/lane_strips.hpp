#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/lane_layout.hpp"
#include "mapping/lanes/lane_track.hpp"

namespace laneloom::lanes {

/// A lane that a frame found, as cross-sections. It refers to the lane.
struct Strip {
  Strip(const Lane& found, const std::vector<Fork>& forks);
  /// The cross-section at an arc length of the center. Its log odds are those of a new lane.
  LaneStation at(double arc_m) const;
  /// Whether the lane was cut at that end, because another one branches off there.
  bool is_cut(End end) const { return cut[index(end)]; }
  /// The boundary on a side.
  ElementId boundary(Side side) const { return lane.borders(side).front().boundary; }

  const Lane& lane;
  MeasuredPolyline center;
  std::vector<LaneStation> stations;  ///< one for each point of the center
  Box box;                            ///< around the strip
  std::array<bool, 2> cut{};          ///< by end
};

/// The place of a station of a track in a frame.
struct Match {
  std::optional<std::size_t> strip;  ///< that shows the lane there, by its index
  double arc_m = 0.0;                ///< on the center of the strip
  bool reversed = false;             ///< the strip runs against the track
  bool is_taken = false;             ///< another lane lies there, or a shoulder
  bool is_denied = false;            ///< the frame shows the borders, and says that no lane lies there
};

/// Per station of a track, its place in the strips of a frame. `found` has the denied stretches and the
/// shoulders of the frame.
std::vector<Match> match(const LaneTrack& track, const std::vector<Strip>& strips, const LaneLayout& found);

}  // namespace laneloom::lanes
