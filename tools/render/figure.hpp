#pragma once

#include <string>
#include <vector>

#include "drawing/drawing.hpp"
#include "laneloom/config.hpp"
#include "render/image.hpp"

/// Pictures of maps, seen from above with the vehicle's forward direction up.
namespace laneloom::render {

/// A picture with its title.
struct Panel {
  std::string title;
  drawing::Drawing drawing;
};

/// Panels of one moment, side by side.
struct Moment {
  std::string label;  ///< such as its time
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::vector<Panel> panels;
};

/// A picture of moments, one below another.
struct Figure {
  std::string title;
  RangeConfig range;  ///< the map's range box, which is shown with a little around it
  std::vector<Moment> moments;
};

/// Draws the moments below one another, with legend and scale, as PNG or SVG by the extension of `path`.
/// Throws std::runtime_error if it can't be written.
void draw_figure(const Figure& figure, const std::string& path);
/// The same as pixels, at twice the size as a PNG has them.
Image draw_image(const Figure& figure);
/// The same as the text of an SVG file.
std::string draw_svg(const Figure& figure);

}  // namespace laneloom::render
