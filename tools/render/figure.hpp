#pragma once

#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

/// Pictures of maps, seen from above with the vehicle's forward direction up.
namespace laneloom {

/// What one picture shows.
struct Panel {
  std::string title;
  LocalMap map;                 ///< boundaries, stoplines, lanes and linkages, map frame
  std::vector<Polyline> truth;  ///< drawn thin and grey beneath, map frame
};

/// Panels of one moment, side by side.
struct Moment {
  std::string label;  ///< such as its time
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::vector<Panel> panels;
};

struct Figure {
  std::string title;
  RangeConfig range;  ///< the map's range box: shown, with a little around it
  std::vector<Moment> moments;
};

/// Draws the moments below one another, with legend and scale, as PNG or SVG by the extension of `path`.
/// Throws std::runtime_error if it can't be written.
void draw_figure(const Figure& figure, const std::string& path);

/// The detections of one frame as a map to draw: what is sure is opaque. Map frame.
LocalMap map_of(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body);

}  // namespace laneloom
