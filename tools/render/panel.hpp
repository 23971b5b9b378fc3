#pragma once

#include "render/canvas.hpp"
#include "render/figure.hpp"

namespace laneloom {

/// Where things of the map come to lie on the canvas: body frame, forward up.
class PanelView {
 public:
  PanelView(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, const Pixel& top_left);

  static Pixel size(const RangeConfig& range);
  static constexpr double kPixelsPerMetre = 13.0;

  const Pixel& top_left() const { return top_left_; }
  Pixel body(double forward_m, double left_m) const;
  Outline map(const Polyline& line) const;

 private:
  Pixel origin_;  ///< the vehicle
  Pixel top_left_;
  Eigen::Isometry3d T_body_map_;
};

/// The way that a linkage takes: out of the end of one lane's centerline and into the begin of the other's,
/// also where traffic runs against them, as linkages are in the order of the points.
Polyline linkage_path(const Linkage& linkage, const Lane& from, const Lane& to);

void draw_panel(Canvas& canvas, const PanelView& view, const RangeConfig& range, const Panel& panel);

/// The key to the colours, in as many lines as fit into `width`.
void draw_legend(Canvas& canvas, const Pixel& top_left, double width);
double legend_height(double width);

}  // namespace laneloom
