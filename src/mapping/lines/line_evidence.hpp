#pragma once

#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "mapping/geometry/local_range.hpp"
#include "mapping/lines/line_map.hpp"
#include "mapping/markings/relatives.hpp"

namespace laneloom {

/// What of the map the network could have seen in a frame.
struct View {
  Eigen::Isometry3d T_body_map = Eigen::Isometry3d::Identity();
  const DetectionFrame* frame = nullptr;

  /// Whether a marking of `type` at a point of the map would have been seen.
  bool sees(const Point& point_map, MarkingType type, const LocalRange& range) const;
};

/// Lowers the evidence of the stations that were in view and not observed, the less the further they are.
void discount_unobserved(const View& view, const LocalRange& range, const FusionConfig& config,
                         std::vector<Line>& lines);

/// Takes away what has lost its evidence or left the range: ends are cut, a line that is lost in between is
/// split. Its longest piece keeps the id; returns the others, each with the line that it was cut off from.
std::vector<Relative> prune_lines(const LocalRange& range, const FusionConfig& config,
                                  std::vector<Line>& lines, ElementId& next_id);

}  // namespace laneloom
