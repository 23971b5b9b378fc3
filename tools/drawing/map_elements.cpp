#include "drawing/map_elements.hpp"

#include "drawing/marking_shapes.hpp"
#include "drawing/properties.hpp"
#include "io/json_fields.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

constexpr double kSigmas = 2.0;

Element element_of(Layer layer, const Marking& marking, nlohmann::json properties) {
  return {.layer = layer,
          .key = key_of(layer, marking.id),
          .id = marking.id,
          .type = name(marking.type),
          .status = marking.status,
          .properties = std::move(properties),
          .shapes = marking_shapes(marking, opacity_of(marking.existence_probability))};
}

/// The direction to the left at each point of a line, of unit length.
std::vector<Point> normals(const Polyline& line) {
  std::vector<Point> out(line.size(), Point::Zero());
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Point along = line[std::min(i + 1, line.size() - 1)] - line[i == 0 ? 0 : i - 1];
    const double length_m = along.head<2>().norm();
    if (length_m > 0.0) out[i] = Point(-along.y(), along.x(), 0.0) / length_m;
  }
  return out;
}

DrawnArea band(const Marking& marking) {
  DrawnArea area;
  const std::vector<Point> left = normals(marking.points);
  for (std::size_t i = 0; i < marking.points.size(); ++i) {
    const Point reach = kSigmas * marking.lateral_stddev_m[i] * left[i];
    area.left.emplace_back(marking.points[i] + reach);
    area.right.emplace_back(marking.points[i] - reach);
  }
  return area;
}

void add_id(const char* type, ElementId id, const Polyline& line, Drawing& drawing) {
  if (!drawable(line)) return;
  const MeasuredPolyline measured(line);
  drawing.add({.layer = Layer::ids,
               .key = std::string("ids/") + type + "/" + std::to_string(id),
               .id = id,
               .type = type,
               .status = {},
               .shapes = {{DrawnText{measured.at(measured.length() / 2.0), std::to_string(id)}, Style::id}}});
}

}  // namespace

void add_boundaries(const LocalMap& map, Drawing& drawing) {
  for (const Marking& marking : map.boundaries)
    drawing.add(element_of(Layer::boundaries, marking, properties_of(marking, map)));
}

void add_stoplines(const LocalMap& map, Drawing& drawing) {
  for (const Stopline& stopline : map.stoplines)
    drawing.add(element_of(Layer::stoplines, stopline.marking, properties_of(stopline, map)));
}

void add_way(const Way& way, Drawing& drawing) {
  DrawnLine line;
  for (const WayStation& station : way.stations) line.points.push_back(station.point);
  drawing.add({.layer = Layer::way,
               .key = "way",
               .type = "way",
               .status = {},
               .properties = properties_of(way),
               .shapes = {{std::move(line), Style::way}}});
}

void add_driven_path(const DrivenPath& path, Drawing& drawing) {
  if (!drawable(path.points)) return;
  drawing.add({.layer = Layer::traffic,
               .key = "driven path/" + std::to_string(path.id),
               .id = path.id,
               .type = "driven path",
               .status = {},
               .properties = {{"length_m", rounded(length(path.points))},
                              {"probability", rounded(path.probability)},
                              {"lateral_stddev_m", rounded(path.lateral_stddev_m)}},
               .shapes = arrow_along(path.points, Style::driven, opacity_of(path.probability))});
}

void add_map(const LocalMap& map, Drawing& drawing) {
  drawing.stamp_ns = map.stamp_ns;
  drawing.T_map_body = map.T_map_body;
  drawing.lineage = map.lineage;
  add_lanes(map, drawing);
  add_boundaries(map, drawing);
  add_stoplines(map, drawing);
  add_linkages(map, drawing);
  if (map.way) add_way(*map.way, drawing);
  for (const DrivenPath& path : map.driven_paths) add_driven_path(path, drawing);
}

void add_markings(const LocalMap& map, Drawing& drawing) {
  for (const Marking& marking : map.markings)
    drawing.add(element_of(Layer::markings, marking, properties_of(marking, map)));
}

void add_uncertainty(const LocalMap& map, Drawing& drawing) {
  for (const Marking& marking : map.boundaries) {
    if (!drawable(marking.points) || marking.lateral_stddev_m.size() != marking.points.size()) continue;
    drawing.add({.layer = Layer::uncertainty,
                 .key = key_of(Layer::uncertainty, marking.id),
                 .id = marking.id,
                 .type = name(marking.type),
                 .status = marking.status,
                 .shapes = {{band(marking), Style::uncertainty}}});
  }
}

void add_ids(const LocalMap& map, Drawing& drawing) {
  for (const Lane& lane : map.lanes) add_id("lane", lane.id, lane.centerline, drawing);
  for (const Marking& marking : map.boundaries)
    add_id(name(marking.type), marking.id, marking.points, drawing);
  for (const Stopline& stopline : map.stoplines)
    add_id(name(stopline.marking.type), stopline.marking.id, stopline.marking.points, drawing);
}

}  // namespace laneloom::drawing
