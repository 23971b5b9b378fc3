#pragma once

#include "render/canvas.hpp"
#include "render/figure.hpp"

namespace laneloom::render {

/// Takes places of the map to places on the canvas: body frame, forward up.
class PanelView {
 public:
  PanelView(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, const Pixel& top_left);

  static Pixel size_of(const RangeConfig& range);
  static constexpr double kPixelsPerMetre = 13.0;

  const Pixel& top_left() const { return top_left_; }
  const Pixel& size() const { return size_; }
  Pixel map(const Point& point) const;
  Outline map(const Polyline& line) const;

 private:
  Pixel origin_;  ///< place of the vehicle
  Pixel top_left_;
  Pixel size_;
  Eigen::Isometry3d T_body_map_;
};

/// Draws the range's box, with the part of the drawing that is in view.
void draw_panel(Canvas& canvas, const PanelView& view, const drawing::Drawing& drawing);

/// Draws the legend of the colours, in as many columns as fit into `width`.
void draw_legend(Canvas& canvas, const Pixel& top_left, double width);
double legend_height(double width);

}  // namespace laneloom::render
