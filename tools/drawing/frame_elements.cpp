#include "drawing/frame_elements.hpp"

#include "drawing/marking_shapes.hpp"
#include "drawing/properties.hpp"
#include "io/json_fields.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

Polyline in_map(const Polyline& line, const Eigen::Isometry3d& T_map_body) {
  Polyline out;
  out.reserve(line.size());
  for (const Point& point : line) out.emplace_back(T_map_body * point);
  return out;
}

Element element_of(const Detection& detection, const DetectionFrame& frame, std::size_t number,
                   const Eigen::Isometry3d& T_map_body) {
  Marking marking;
  marking.type = detection.type;
  marking.points = in_map(detection.points, T_map_body);
  marking.styles = {{{0.0, length(marking.points)}, detection.style}};
  return {.layer = Layer::detections,
          .key = key_of(Layer::detections, number),
          .id = kNoElement,
          .type = name(detection.type),
          .status = {},
          .properties = {{"confidence", rounded(detection.confidence)},
                         {"style", name(detection.style)},
                         {"length_m", rounded(length(detection.points))},
                         {"source", frame.source},
                         {"frame", frame.sequence}},
          .shapes = marking_shapes(marking, opacity_of(detection.confidence))};
}

/// The outline of a car in the body frame, with cut corners at its front.
Polyline car_outline(double rear, double front, double half_width, double corner) {
  return {{rear, half_width, 0.0},
          {front - corner, half_width, 0.0},
          {front, half_width - corner, 0.0},
          {front, corner - half_width, 0.0},
          {front - corner, -half_width, 0.0},
          {rear, -half_width, 0.0}};
}

Element area(Layer layer, const std::string& key, Polyline outline, Style style) {
  Element element{.layer = layer, .key = key, .type = palette::of(style).name, .status = {}, .shapes = {}};
  if (outline.size() >= 3) element.shapes.push_back({DrawnArea{std::move(outline), {}}, style});
  return element;
}

}  // namespace

void add_detections(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Drawing& drawing) {
  std::size_t number = 0;
  for (const Detection& detection : frame.detections)
    drawing.add(element_of(detection, frame, number++, T_map_body));
}

void add_view(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body, Drawing& drawing) {
  drawing.add(area(Layer::field_of_view, "field_of_view", in_map(frame.field_of_view, T_map_body),
                   Style::field_of_view));
  std::size_t number = 0;
  for (const Polyline& occluded : frame.occluded_areas)
    drawing.add(area(Layer::occlusions, key_of(Layer::occlusions, number++), in_map(occluded, T_map_body),
                     Style::occlusion));
}

void add_vehicle(const Eigen::Isometry3d& T_map_body, Drawing& drawing) {
  const auto part = [&](const Polyline& outline, Style style) {
    return Shape{DrawnArea{in_map(outline, T_map_body), {}}, style};
  };
  drawing.add({.layer = Layer::vehicle,
               .key = "vehicle",
               .type = "vehicle",
               .status = {},
               .shapes = {part(car_outline(-1.0, 3.7, 0.95, 0.5), Style::vehicle),
                          part(car_outline(1.7, 2.5, 0.75, 0.2), Style::window),
                          part(car_outline(-0.6, -0.1, 0.70, 0.0), Style::window)}});
}

void add_range(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, Drawing& drawing) {
  const double rear = range.forward_min_m, front = range.forward_max_m, side = range.side_max_m;
  const Polyline box{
      {front, side, 0.0}, {front, -side, 0.0}, {rear, -side, 0.0}, {rear, side, 0.0}, {front, side, 0.0}};
  drawing.add({.layer = Layer::range,
               .key = "range",
               .type = "range",
               .status = {},
               .shapes = {{DrawnLine{in_map(box, T_map_body)}, Style::range}}});
}

}  // namespace laneloom::drawing
