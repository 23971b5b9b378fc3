#include "drawing/traffic_elements.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "drawing/marking_shapes.hpp"
#include "drawing/properties.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/topology/traffic.hpp"

namespace laneloom::drawing {
namespace {

constexpr double kUsualLength_m = 4.5, kUsualWidth_m = 1.8;
constexpr double kUnknownHeading_m = 1.0;  ///< side of the box of an object whose heading is not known
constexpr double kToldSpacing_m = 9.0;

/// An object of one run of a tracker.
using ObjectName = std::pair<std::uint64_t, std::uint64_t>;

std::string key_of(const char* what, std::uint64_t session, std::uint64_t object) {
  return drawing::key_of(Layer::traffic, session) + "/" + what + "/" + std::to_string(object);
}

/// The outline of an object in the map frame.
Polyline box_of(const TrackedObject& object, const Eigen::Isometry3d& T_map_body) {
  const bool is_turned = !object.heading.isZero();
  const auto known = [&](double size_m, double usual_m) {
    if (!is_turned) return kUnknownHeading_m;
    return size_m > 0.0 ? size_m : usual_m;
  };
  const Point along = is_turned ? object.heading : Point(Point::UnitX());
  const Point half_length = 0.5 * known(object.length_m, kUsualLength_m) * along;
  const Point half_width = 0.5 * known(object.width_m, kUsualWidth_m) * Point(-along.y(), along.x(), 0.0);
  Polyline box;
  for (const auto& [front, left] : {std::pair{1, 1}, {1, -1}, {-1, -1}, {-1, 1}})
    box.emplace_back(T_map_body * (object.position + front * half_length + left * half_width));
  return box;
}

nlohmann::json properties_of(const TrackedObject& object) {
  nlohmann::json out{{"object", object.id}, {"speed_mps", rounded(object.speed_mps)}};
  if (object.existence_probability >= 0.0)
    out["existence_probability"] = rounded(object.existence_probability);
  if (object.position_stddev_m >= 0.0) out["position_stddev_m"] = rounded(object.position_stddev_m);
  if (object.length_m >= 0.0) out["length_m"] = rounded(object.length_m);
  if (object.width_m >= 0.0) out["width_m"] = rounded(object.width_m);
  return out;
}

Element element_of(const trails::Trail& trail, std::size_t number) {
  const Polyline& points = trail.points;
  Element element{.layer = Layer::traffic,
                  .key = key_of("trail", trail.session, trail.object) + "/" + std::to_string(number),
                  .type = "trail",
                  .status = {},
                  .properties = {{"object", trail.object}, {"speed_mps", rounded(trail.speed_mps)}},
                  .shapes = {}};
  if (!drawable(points)) return element;
  element.properties["length_m"] = rounded(length(points));
  element.shapes = arrow_along(points, Style::trail);
  return element;
}

/// The arrows along a lane whose direction is told by trails. There are none on another lane.
Element told_direction(const Lane& lane) {
  Element element{.layer = Layer::traffic,
                  .key = drawing::key_of(Layer::traffic, lane.id),
                  .type = "told direction",
                  .status = {},
                  .shapes = {}};
  if (!overlap(lane.direction_evidence, Evidence::traffic) || !drawable(lane.centerline)) return element;
  const double sense = lane.direction == Lane::Direction::against_centerline ? -1.0 : 1.0;
  const MeasuredPolyline line(lane.centerline);
  const double count = std::max(1.0, std::floor(line.length() / kToldSpacing_m));
  for (double i = 0.5; i < count; i += 1.0) {
    const double tip_m = line.length() * i / count;
    const Eigen::Vector2d along = sense * line.direction(tip_m);
    element.shapes.push_back({DrawnArrow{line.at(tip_m), {along.x(), along.y(), 0.0}}, Style::told});
  }
  return element;
}

}  // namespace

void add_objects(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body, Drawing& drawing) {
  for (const TrackedObject& object : objects.objects)
    drawing.add({.layer = Layer::traffic,
                 .key = key_of("object", objects.session_id, object.id),
                 .type = name(object.kind),
                 .status = {},
                 .properties = properties_of(object),
                 .shapes = {{DrawnArea{box_of(object, T_map_body), {}}, Style::object,
                             opacity_of(object.existence_probability)}}});
}

void add_trails(const std::vector<trails::Trail>& trails, const LocalMap& map, Drawing& drawing) {
  std::vector<Element> elements;
  elements.reserve(trails.size());
  std::map<ObjectName, std::size_t> count;
  for (const trails::Trail& trail : trails)
    elements.push_back(element_of(trail, count[{trail.session, trail.object}]++));
  for (const topology::DrivenStretch& stretch : topology::driven_stretches(trails, map.lanes))
    if (std::abs(stretch.along_m) >= topology::kMinDriven_m)
      elements[stretch.trail].properties["drove"].push_back(
          {{"lane", map.lanes[stretch.lane].id}, {"along_m", rounded(stretch.along_m)}});
  for (const Lane& lane : map.lanes) drawing.add(told_direction(lane));
  for (Element& element : elements) drawing.add(std::move(element));
}

}  // namespace laneloom::drawing
