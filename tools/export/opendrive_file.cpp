#include "export/opendrive_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "export/carriageways.hpp"
#include "export/road_links.hpp"
#include "io/text_file.hpp"

namespace laneloom::exports {
namespace {

constexpr double kStopLineLength_m = 0.4;  // along the road

using Way = RoadNetwork::Way;

void set(pugi::xml_node& element, const char* name, double value) {
  element.append_attribute(name) = fmt::format("{:.6f}", value).c_str();
}
void set_number(pugi::xml_node& element, const char* name, std::size_t value) {
  element.append_attribute(name) = static_cast<unsigned long long>(value);
}
void set_cubic(pugi::xml_node& element, double a, double b) {
  set(element, "a", a);
  set(element, "b", b);
  set(element, "c", 0.0);
  set(element, "d", 0.0);
}

const char* mark_type(const Way& way) {
  if (way.kind == Way::Kind::roadedge) return "edge";
  if (way.kind != Way::Kind::laneline) return "none";
  if (way.style == MarkingStyle::dashed) return "broken";
  return way.style == MarkingStyle::solid ? "solid" : "custom";
}

void add_plan_view(const Carriageway& way, pugi::xml_node& road) {
  pugi::xml_node view = road.append_child("planView");
  for (std::size_t i = 0; i < way.curves.size(); ++i) {
    const CrossSection& from = way.cross_sections[i];
    const Curve& curve = way.curves[i];
    pugi::xml_node geometry = view.append_child("geometry");
    set(geometry, "s", from.along_m);
    set(geometry, "x", from.place.x());
    set(geometry, "y", from.place.y());
    set(geometry, "hdg", from.heading_rad);
    set(geometry, "length", curve.length_m);
    pugi::xml_node cubic = geometry.append_child("paramPoly3");
    for (const auto& [letter, axis] : {std::pair("U", 0), {"V", 1}}) {
      const auto name = [letter = letter](const char* part) { return std::string(part) + letter; };
      set(cubic, name("a").c_str(), 0.0);
      set(cubic, name("b").c_str(), curve.b[axis]);
      set(cubic, name("c").c_str(), curve.c[axis]);
      set(cubic, name("d").c_str(), curve.d[axis]);
    }
    cubic.append_attribute("pRange") = "normalized";
  }
}

/// Adds records of values that run evenly from one cross-section to the next. `value` gives that of a number.
template <typename Value>
void add_even(const Carriageway& way, pugi::xml_node& parent, const char* name, const char* start,
              Value value) {
  for (std::size_t i = 0; i < way.curves.size(); ++i) {
    pugi::xml_node record = parent.append_child(name);
    set(record, start, way.cross_sections[i].along_m);
    set_cubic(record, value(i), (value(i + 1) - value(i)) / way.curves[i].length_m);
  }
}

void add_mark(const Way& way, pugi::xml_node& lane) {
  pugi::xml_node mark = lane.append_child("roadMark");
  set(mark, "sOffset", 0.0);
  mark.append_attribute("type") = mark_type(way);
  mark.append_attribute("weight") = "standard";
  mark.append_attribute("color") = "standard";
  set(mark, "width", 0.12);
}

pugi::xml_node add_lane(pugi::xml_node& side, int id, const char* type) {
  pugi::xml_node lane = side.append_child("lane");
  lane.append_attribute("id") = id;
  lane.append_attribute("type") = type;
  lane.append_attribute("level") = "false";
  return lane;
}

const char* lane_type(const RoadNetwork::Lanelet& lanelet) {
  if (lanelet.use == Lane::Use::shoulder) return "shoulder";
  if (lanelet.use == Lane::Use::parking) return "parking";
  if (lanelet.use == Lane::Use::cycle) return "biking";
  return lanelet.one_way ? "driving" : "bidirectional";
}

/// Writes the roads of a network.
class Writer {
 public:
  explicit Writer(const RoadNetwork& network)
      : network_(network), roads_(carriageways(network)), links_(network, roads_) {}

  void write(pugi::xml_node& root) const {
    pugi::xml_node header = root.append_child("header");
    header.append_attribute("revMajor") = 1;
    header.append_attribute("revMinor") = 7;
    header.append_attribute("vendor") = "laneloom";
    for (std::size_t road = 0; road < roads_.size(); ++road) add_road(road, root);
    add_junctions(root);
  }

 private:
  void add_road(std::size_t number, pugi::xml_node& root) const {
    const Carriageway& way = roads_[number];
    pugi::xml_node road = root.append_child("road");
    set(road, "length", way.length_m());
    set_number(road, "id", number);
    if (const auto junction = links_.junction_of(number))
      set_number(road, "junction", *junction);
    else
      road.append_attribute("junction") = "-1";
    pugi::xml_node link = road.append_child("link");
    add_link(number, false, link);
    add_link(number, true, link);
    add_plan_view(way, road);
    pugi::xml_node elevation = road.append_child("elevationProfile");
    add_even(way, elevation, "elevation", "s",
             [&](std::size_t i) { return way.cross_sections[i].place.z(); });
    add_lanes(number, road);
    add_stop_lines(number, road);
  }

  void add_link(std::size_t road, bool behind, pugi::xml_node& link) const {
    const auto junction = links_.junction_at(road, behind);
    const auto linked = links_.linked(road, behind);
    if (!junction && !linked) return;
    pugi::xml_node element = link.append_child(behind ? "successor" : "predecessor");
    element.append_attribute("elementType") = junction ? "junction" : "road";
    set_number(element, "elementId", junction ? *junction : *linked);
    if (!junction) element.append_attribute("contactPoint") = behind ? "start" : "end";
  }

  void add_lanes(std::size_t number, pugi::xml_node& road) const {
    const Carriageway& way = roads_[number];
    pugi::xml_node section = road.append_child("lanes").append_child("laneSection");
    set(section, "s", 0.0);
    pugi::xml_node center = section.append_child("center"), right = section.append_child("right");
    pugi::xml_node centre_lane = add_lane(center, 0, "none");
    add_mark(network_.ways[network_.lanelets[way.lanelets.front()].left.way], centre_lane);
    for (std::size_t i = 0; i < way.lanelets.size(); ++i) {
      const RoadNetwork::Lanelet& lanelet = network_.lanelets[way.lanelets[i]];
      const int id = -1 - static_cast<int>(i);
      pugi::xml_node lane = add_lane(right, id, lane_type(lanelet));
      pugi::xml_node link = lane.append_child("link");
      add_lane_link(number, id, false, link);
      add_lane_link(number, id, true, link);
      add_even(way, lane, "width", "sOffset",
               [&](std::size_t section_number) { return way.cross_sections[section_number].widths_m[i]; });
      add_mark(network_.ways[lanelet.right.way], lane);
    }
  }

  void add_lane_link(std::size_t road, int lane, bool behind, pugi::xml_node& link) const {
    const auto linked = links_.linked(road, behind);
    if (!linked || links_.junction_at(road, behind)) return;
    for (const auto& [from, to] : behind ? links_.lanes(road, *linked) : links_.lanes(*linked, road))
      if ((behind ? from : to) == lane)
        link.append_child(behind ? "successor" : "predecessor").append_attribute("id") = behind ? to : from;
  }

  void add_stop_lines(std::size_t number, pugi::xml_node& road) const {
    pugi::xml_node objects;
    for (std::size_t i = 0; i < network_.stops.size(); ++i) {
      const RoadNetwork::StopElement& stop = network_.stops[i];
      if (stop.lanelets.empty() || links_.road_of(stop.lanelets.front()) != number) continue;
      if (!objects) objects = road.append_child("objects");
      add_stop_line(number, i, objects);
    }
  }

  void add_stop_line(std::size_t number, std::size_t stop, pugi::xml_node& objects) const {
    const std::vector<std::size_t>& nodes = network_.ways[network_.stops[stop].way].nodes;
    const Point &begin = network_.nodes[nodes.front()], &end = network_.nodes[nodes.back()];
    const Point middle = 0.5 * (begin + end), across = end - begin;
    const auto distance_m = [&](const CrossSection& section) { return (section.place - middle).norm(); };
    const CrossSection& near = *std::ranges::min_element(roads_[number].cross_sections, {}, distance_m);
    const Eigen::Vector2d offset = Eigen::Rotation2Dd(-near.heading_rad) * (middle - near.place).head<2>();
    pugi::xml_node object = objects.append_child("object");
    set_number(object, "id", stop);
    object.append_attribute("type") = "roadMark";
    object.append_attribute("subtype") = "signalLines";
    object.append_attribute("name") = "StopLine";
    set(object, "s", std::clamp(near.along_m + offset.x(), 0.0, roads_[number].length_m()));
    set(object, "t", offset.y());
    set(object, "zOffset", 0.0);
    // An angle to the road between -90° and 90°: the line has no direction.
    const double turn_rad = std::atan2(-across.x(), across.y()) - near.heading_rad;
    set(object, "hdg", std::atan(std::tan(turn_rad)));
    set(object, "width", across.head<2>().norm());
    set(object, "length", kStopLineLength_m);
    object.append_attribute("orientation") = "+";
  }

  void add_junctions(pugi::xml_node& root) const {
    for (const auto& [number, connections] : links_.junctions()) {
      pugi::xml_node junction = root.append_child("junction");
      set_number(junction, "id", number);
      junction.append_attribute("name") = "";
      std::size_t count = 0;
      for (const auto& [road, incoming] : connections) {
        pugi::xml_node connection = junction.append_child("connection");
        set_number(connection, "id", count++);
        set_number(connection, "incomingRoad", incoming);
        set_number(connection, "connectingRoad", road);
        connection.append_attribute("contactPoint") = "start";
        for (const auto& [from, to] : links_.lanes(incoming, road)) {
          pugi::xml_node link = connection.append_child("laneLink");
          link.append_attribute("from") = from;
          link.append_attribute("to") = to;
        }
      }
    }
  }

  const RoadNetwork& network_;
  std::vector<Carriageway> roads_;
  RoadLinks links_;
};

}  // namespace

void write_opendrive(const std::filesystem::path& path, const RoadNetwork& network) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("OpenDRIVE");
  Writer(network).write(root);
  io::TextFile file(path);
  document.save(file.stream(), "  ");
  file.close();
}

}  // namespace laneloom::exports
