#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "drawing/colour.hpp"

/// Curves over a common axis.
namespace laneloom::render {

/// One curve, in the units of its axes.
struct Curve {
  std::string name;
  drawing::Colour colour;
  std::vector<Eigen::Vector2d> points;  ///< by ascending x; the curve has a gap where y is NaN
};

/// Curves over one pair of axes.
struct Plot {
  std::string title;  ///< the meaning of y, with its unit
  std::string x_label;
  std::optional<double> y_max;  ///< end of the axis, which begins at 0; none: as the curves need it
  bool binned = false;          ///< each point stands for an interval around it, and is marked
  std::vector<Curve> curves;    ///< y not negative
};

/// The step between ticks of an axis over `span`: 1, 2 or 5 times a power of ten, for about `ticks` of them.
/// 1 where the span is not positive and finite.
double tick_step(double span, int ticks);

/// Draws the plots below one another, each with a legend of its curves, as PNG or SVG by the extension of
/// `path`. Throws std::runtime_error if it can't be written.
void draw_plots(const std::vector<Plot>& plots, const std::string& path);

}  // namespace laneloom::render
