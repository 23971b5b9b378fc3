#include "ros2/markers.hpp"

#include <utility>

#include "laneloom/state_names.hpp"
#include "ros2/parts.hpp"
#include "ros2/shapes.hpp"

namespace laneloom::ros2 {
namespace {

constexpr double kLine_m = 0.15;
constexpr double kStopline_m = 0.4;
constexpr double kPath_m = 0.08;
constexpr double kWay_m = 0.3;
constexpr double kText_m = 1.0;
constexpr std::int32_t kLifetime_s = 1;  // ten ticks

Color color_of(const Lane& lane) {
  if (lane.status == ElementStatus::inferred) return {0.9F, 0.6F, 0.1F, 0.2F};
  return {0.1F, 0.7F, 0.3F, lane.status == ElementStatus::confirmed ? 0.3F : 0.15F};
}

Color color_of(MapState state) {
  switch (state) {
    case MapState::ok:
      return {0.2F, 0.9F, 0.3F, 1.0F};
    case MapState::degraded:
      return {1.0F, 0.7F, 0.1F, 1.0F};
    case MapState::stale:
      break;
  }
  return {1.0F, 0.2F, 0.2F, 1.0F};
}

}  // namespace

visualization_msgs::msg::dds_::MarkerArray_ Markers::update(const PublishedMap& map) {
  ++updates_;
  markers_.clear();
  add_lanes(map);
  add_boundaries(map);
  add_stoplines(map);
  add_linkages(map);
  add_way(map);
  add_state(map);
  delete_gone(map);
  visualization_msgs::msg::dds_::MarkerArray_ array;
  array.markers(std::move(markers_));
  return array;
}

Markers::Marker& Markers::add(const PublishedMap& map, const Element& element) {
  const auto [shown, is_new] = shown_.try_emplace(element);
  if (is_new) shown->second.id = next_id_++;
  shown->second.update = updates_;
  Marker& marker = markers_.emplace_back();
  marker.header(to_header(map.map.stamp_ns, map.frame_id));
  marker.ns(element.ns);
  marker.id(shown->second.id);
  marker.action(kAdd);
  marker.pose().orientation().w(1.0);
  marker.lifetime().sec(kLifetime_s);
  return marker;
}

void Markers::add_boundaries(const PublishedMap& map) {
  for (const Marking& boundary : map.map.boundaries)
    make_styled_line(boundary, kLine_m, add(map, {"boundaries", boundary.id}));
}

void Markers::add_lanes(const PublishedMap& map) {
  for (const Lane& lane : map.map.lanes)
    make_area(lane.left, lane.right, color_of(lane), add(map, {"lanes", lane.id}));
}

void Markers::add_stoplines(const PublishedMap& map) {
  for (const Stopline& stopline : map.map.stoplines) {
    const Marking& marking = stopline.marking;
    make_line(marking.points, kStopline_m, {1.0F, 0.2F, 0.2F, 1.0F}, add(map, {"stoplines", marking.id}));
  }
}

void Markers::add_linkages(const PublishedMap& map) {
  for (const Linkage& linkage : map.map.linkages) {
    if (linkage.path.size() < 2) continue;  // the lanes meet
    make_line(linkage.path, kPath_m, {0.8F, 0.4F, 1.0F, 1.0F},
              add(map, {"linkages", linkage.from, linkage.to}));
  }
}

void Markers::add_way(const PublishedMap& map) {
  if (!map.map.way) return;
  Polyline points;
  for (const WayStation& station : map.map.way->stations) points.push_back(station.point);
  make_line(points, kWay_m, {1.0F, 0.6F, 0.1F, 0.9F}, add(map, {"way"}));
}

void Markers::add_state(const PublishedMap& map) {
  const Point above = map.map.T_map_body * Point(0.0, 0.0, 3.0);
  make_text(above, state_text(map.state, map.reasons), kText_m, color_of(map.state), add(map, {"state"}));
}

void Markers::delete_gone(const PublishedMap& map) {
  for (auto shown = shown_.begin(); shown != shown_.end();) {
    if (shown->second.update == updates_) {
      ++shown;
      continue;
    }
    Marker& marker = markers_.emplace_back();
    marker.header(to_header(map.map.stamp_ns, map.frame_id));
    marker.ns(shown->first.ns);
    marker.id(shown->second.id);
    marker.action(kDelete);
    marker.pose().orientation().w(1.0);
    shown = shown_.erase(shown);
  }
}

}  // namespace laneloom::ros2
