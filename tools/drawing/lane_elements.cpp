#include <algorithm>
#include <cmath>
#include <utility>

#include "drawing/map_elements.hpp"
#include "drawing/marking_shapes.hpp"
#include "drawing/properties.hpp"
#include "laneloom/lane_graph.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

constexpr double kArrowSpacing_m = 9.0;
constexpr double kLinkageReach_m = 3.5;  ///< length of a linkage's arrow within either lane
constexpr double kCenterlineOpacity = 0.6;
constexpr double kPathOpacity = 0.85;      ///< of a linkage
constexpr double kUnknownDirection = 0.6;  ///< opacity of a lane whose driving direction is not known
constexpr double kHatchSpacing_m = 1.5;    ///< along an inferred stretch

Point as_point(const Eigen::Vector2d& direction) { return {direction.x(), direction.y(), 0.0}; }

/// Adds the centerline, in driving direction if it is known, and arrows along it.
void add_course(const Lane& lane, LaneRole role, std::vector<Shape>& shapes) {
  if (!drawable(lane.centerline)) return;
  Polyline centerline = lane.centerline;
  if (lane.direction == Lane::Direction::against_centerline)
    std::reverse(centerline.begin(), centerline.end());
  const double opacity = lane.direction == Lane::Direction::unknown ? kUnknownDirection : 1.0;
  const Style style = palette::course_style(role);
  const MeasuredPolyline line(centerline);
  shapes.push_back({DrawnLine{std::move(centerline)}, style, kCenterlineOpacity * opacity});
  const auto arrows = std::max(1.0, std::floor(line.length() / kArrowSpacing_m));
  for (double i = 0.5; i < arrows; i += 1.0) {
    const double tip_m = line.length() * i / arrows;
    const Point tip = line.at(tip_m), along = as_point(line.direction(tip_m));
    shapes.push_back({DrawnArrow{tip, along}, style, opacity});
    if (lane.direction == Lane::Direction::both) shapes.push_back({DrawnArrow{tip, -along}, style, opacity});
  }
}

/// The stretches of a lane that are concluded: all of an inferred lane.
std::vector<Stretch> concluded(const Lane& lane, double length_m) {
  if (lane.status == ElementStatus::inferred) return {{0.0, length_m}};
  return lane.inferred_ranges;
}

/// Adds a zigzag between the sides of each concluded stretch.
void add_hatching(const Lane& lane, std::vector<Shape>& shapes) {
  const MeasuredPolyline center(lane.centerline), left(lane.left), right(lane.right);
  if (center.length() <= 0.0) return;
  for (const Stretch& range : concluded(lane, center.length())) {
    const auto steps = static_cast<int>((range.to_m - range.from_m) / kHatchSpacing_m);
    DrawnLine zigzag;
    for (int i = 0; i <= steps; ++i) {
      const double share = std::min(1.0, (range.from_m + i * kHatchSpacing_m) / center.length());
      const MeasuredPolyline& side = i % 2 == 0 ? left : right;
      zigzag.points.push_back(side.at(share * side.length()));
    }
    if (drawable(zigzag.points)) shapes.push_back({std::move(zigzag), Style::inferred});
  }
}

Element element_of(const Lane& lane, const LocalMap& map, ElementId own) {
  const LaneRole role = role_of(lane, own, map.T_map_body);
  Element element{.layer = Layer::lanes,
                  .key = key_of(Layer::lanes, lane.id),
                  .id = lane.id,
                  .type = "lane",
                  .status = lane.status,
                  .properties = properties_of(lane, map),
                  .shapes = {}};
  element.properties["role"] = title(role);
  if (drawable(lane.left) && drawable(lane.right)) {
    element.shapes.push_back({DrawnArea{lane.left, lane.right}, palette::lane_style(role)});
    add_hatching(lane, element.shapes);
  }
  add_course(lane, role, element.shapes);
  return element;
}

Element element_of(const Linkage& linkage, const Polyline& path) {
  std::vector<Shape> shapes = arrow_along(path, Style::linkage);
  shapes.front().opacity = kPathOpacity;
  return {.layer = Layer::linkages,
          .key = key_of(Layer::linkages, linkage.from) + "-" + std::to_string(linkage.to),
          .id = kNoElement,
          .type = "linkage",
          .status = {},
          .properties = properties_of(linkage),
          .shapes = std::move(shapes)};
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

void add_lanes(const LocalMap& map, Drawing& drawing) {
  const ElementId own = own_lane_of(map);
  for (const Lane& lane : map.lanes) drawing.add(element_of(lane, map, own));
}

void add_linkages(const LocalMap& map, Drawing& drawing) {
  const LaneGraph lanes(map);
  const auto is_drawn = [](const Lane* lane) { return lane != nullptr && drawable(lane->centerline); };
  for (const Linkage& linkage : map.linkages) {
    const Lane *from = lanes.find(linkage.from), *to = lanes.find(linkage.to);
    if (is_drawn(from) && is_drawn(to)) drawing.add(element_of(linkage, linkage_path(linkage, *from, *to)));
  }
}

}  // namespace laneloom::drawing
