#include "render/panel.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "laneloom/polyline.hpp"
#include "render/palette.hpp"

namespace laneloom {
namespace {

constexpr double kAroundBox_m = 2.0;
constexpr double kArrowSpacing_m = 9.0;
constexpr double kLinkageReach_m = 3.5;  ///< of its arrow into either lane
constexpr double kMinLength_m = 0.01;
constexpr double kLegendColumn = 125.0;
constexpr double kLegendLine = 18.0;
constexpr double kLegendEntries = 9.0;

bool drawable(const Polyline& line) { return line.size() >= 2 && length(line) > kMinLength_m; }

/// An arrow head with its tip at `tip`.
Outline arrow_head(const Pixel& tip, const Pixel& direction, double size) {
  const Pixel along = direction.normalized() * size, across(-along.y(), along.x());
  return {tip, tip - along + 0.45 * across, tip - 0.7 * along, tip - along - 0.45 * across, tip};
}

void draw_marking(Canvas& canvas, const PanelView& view, const Marking& marking) {
  if (!drawable(marking.points)) return;
  const double opacity =
      marking.existence_probability < 0.0 ? 1.0 : 0.3 + 0.7 * marking.existence_probability;
  const auto draw = [&](const Polyline& stretch, MarkingStyle style) {
    Pen pen = palette::marking_pen(marking.type, style);
    pen.colour = pen.colour.faded(opacity);
    canvas.stroke(view.map(stretch), pen);
  };
  if (marking.styles.empty()) draw(marking.points, MarkingStyle::unknown);
  const MeasuredPolyline line(marking.points);
  for (const StyleRange& style : marking.styles) draw(line.slice(style.range), style.style);
}

void draw_lane(Canvas& canvas, const PanelView& view, const Lane& lane, const Colour& colour) {
  Polyline area = lane.left;
  area.insert(area.end(), lane.right.rbegin(), lane.right.rend());
  canvas.fill(view.map(area), colour);
  if (!drawable(lane.centerline)) return;

  Polyline centerline = lane.centerline;
  if (lane.direction == Lane::Direction::against_centerline)
    std::reverse(centerline.begin(), centerline.end());
  const bool known = lane.direction != Lane::Direction::unknown;
  const Colour dark{colour.red * 0.6, colour.green * 0.6, colour.blue * 0.6, known ? 0.9 : 0.55};
  canvas.stroke(view.map(centerline), {dark.faded(0.6), 0.8, {2.0, 4.0}});
  const MeasuredPolyline line(centerline);
  const auto arrows = std::max(1.0, std::floor(line.length() / kArrowSpacing_m));
  for (double i = 0.5; i < arrows; i += 1.0) {
    const double tip_m = line.length() * i / arrows;
    const Outline stretch = view.map({line.at(std::max(0.0, tip_m - 0.3)), line.at(tip_m)});
    canvas.fill(arrow_head(stretch.back(), stretch.back() - stretch.front(), known ? 9.0 : 7.0), dark);
  }
}

void draw_linkages(Canvas& canvas, const PanelView& view, const LocalMap& map) {
  std::map<ElementId, const Lane*> lanes;
  for (const Lane& lane : map.lanes)
    if (drawable(lane.centerline)) lanes.emplace(lane.id, &lane);
  for (const Linkage& linkage : map.linkages) {
    const auto from = lanes.find(linkage.from), to = lanes.find(linkage.to);
    if (from == lanes.end() || to == lanes.end()) continue;
    const Outline path = view.map(linkage_path(linkage, *from->second, *to->second));
    canvas.stroke(path, {palette::kLinkage.faded(0.85), 1.8, {}});
    canvas.fill(arrow_head(path.back(), path.back() - path[path.size() - 2], 9.0), palette::kLinkage);
  }
}

/// A car of usual size, the origin below its rear axle.
void draw_vehicle(Canvas& canvas, const PanelView& view) {
  const auto outline = [&](double rear, double front, double half_width, double corner) {
    return Outline{view.body(rear, half_width),
                   view.body(front - corner, half_width),
                   view.body(front, half_width - corner),
                   view.body(front, corner - half_width),
                   view.body(front - corner, -half_width),
                   view.body(rear, -half_width)};
  };
  canvas.fill(outline(-1.0, 3.7, 0.95, 0.5), palette::kVehicle.faded(0.9));
  canvas.fill(outline(1.7, 2.5, 0.75, 0.2), {0.80, 0.86, 0.93});
  canvas.fill(outline(-0.6, -0.1, 0.70, 0.0), {0.80, 0.86, 0.93});
}

void draw_box(Canvas& canvas, const PanelView& view, const RangeConfig& range) {
  const Pixel top_left = view.body(range.forward_max_m, range.side_max_m);
  const Pixel bottom_right = view.body(range.forward_min_m, -range.side_max_m);
  canvas.stroke(rectangle(top_left, bottom_right - top_left), {palette::kBox, 0.9, {5.0, 4.0}});
}

}  // namespace

Polyline linkage_path(const Linkage& linkage, const Lane& from, const Lane& to) {
  const MeasuredPolyline out(from.centerline), in(to.centerline);
  Polyline path = out.slice({std::max(0.0, out.length() - kLinkageReach_m), out.length()});
  path.insert(path.end(), linkage.path.begin(), linkage.path.end());
  const Polyline into = in.slice({0.0, std::min(kLinkageReach_m, in.length())});
  path.insert(path.end(), into.begin(), into.end());
  return path;
}

PanelView::PanelView(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, const Pixel& top_left)
    : origin_(top_left +
              kPixelsPerMetre * Pixel(range.side_max_m + kAroundBox_m, range.forward_max_m + kAroundBox_m)),
      top_left_(top_left),
      T_body_map_(T_map_body.inverse()) {}

Pixel PanelView::size(const RangeConfig& range) {
  return kPixelsPerMetre * Pixel(2.0 * range.side_max_m + 2.0 * kAroundBox_m,
                                 range.forward_max_m - range.forward_min_m + 2.0 * kAroundBox_m);
}

Pixel PanelView::body(double forward_m, double left_m) const {
  return origin_ - kPixelsPerMetre * Pixel(left_m, forward_m);
}

Outline PanelView::map(const Polyline& line) const {
  Outline pixels;
  pixels.reserve(line.size());
  for (const Point& point : line) {
    const Point in_body = T_body_map_ * point;
    pixels.push_back(body(in_body.x(), in_body.y()));
  }
  return pixels;
}

void draw_panel(Canvas& canvas, const PanelView& view, const RangeConfig& range, const Panel& panel) {
  const Pixel size = PanelView::size(range);
  canvas.clip(view.top_left(), size);
  canvas.fill(rectangle(view.top_left(), size), palette::kGround);
  for (const Lane& lane : panel.map.lanes)
    draw_lane(canvas, view, lane, palette::kLanes[lane.id % palette::kLanes.size()]);
  for (const Polyline& line : panel.truth) canvas.stroke(view.map(line), {palette::kTruth, 1.0, {}});
  draw_box(canvas, view, range);
  for (const Marking& marking : panel.map.boundaries) draw_marking(canvas, view, marking);
  for (const Stopline& stopline : panel.map.stoplines) draw_marking(canvas, view, stopline.marking);
  draw_linkages(canvas, view, panel.map);
  draw_vehicle(canvas, view);
  canvas.unclip();
  canvas.stroke(rectangle(view.top_left(), size), {palette::kBox.faded(0.6), 0.8, {}});
}

double legend_height(double width) {
  const double columns = std::max(1.0, std::floor(width / kLegendColumn));
  return kLegendLine * std::ceil(kLegendEntries / columns);
}

void draw_legend(Canvas& canvas, const Pixel& top_left, double width) {
  constexpr double kSample = 26.0;
  Pixel at = top_left + Pixel(0.0, kLegendLine / 2);
  const auto next = [&](const std::string& label) {
    canvas.text(at + Pixel(kSample + 6.0, 4.0), label, 11.0, palette::kText);
    at.x() += kLegendColumn;
    if (at.x() + kLegendColumn > top_left.x() + width) at = Pixel(top_left.x(), at.y() + kLegendLine);
  };
  const auto line = [&](const Pen& pen, const std::string& label) {
    canvas.stroke({at, at + Pixel(kSample, 0)}, pen);
    next(label);
  };
  using enum MarkingType;
  line(palette::marking_pen(laneline, MarkingStyle::solid), "solid line");
  line(palette::marking_pen(laneline, MarkingStyle::dashed), "dashed line");
  line(palette::marking_pen(laneline, MarkingStyle::unknown), "unknown style");
  line(palette::marking_pen(roadedge, MarkingStyle::unknown), "road edge");
  line(palette::marking_pen(stopline, MarkingStyle::unknown), "stop line");
  canvas.fill(rectangle(at - Pixel(0, 5), {kSample, 10}), palette::kLanes[0]);
  next("lane");
  canvas.fill(arrow_head(at + Pixel(kSample, 0), {1, 0}, 9.0), palette::kLinkage);
  line({palette::kLinkage, 1.8, {}}, "linkage");
  line({palette::kTruth, 1.0, {}}, "ground truth");
  line({palette::kBox, 0.9, {5.0, 4.0}}, "map range");
}

}  // namespace laneloom
