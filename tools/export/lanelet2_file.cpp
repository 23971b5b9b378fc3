#include "export/lanelet2_file.hpp"

#include <fmt/format.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <pugixml.hpp>
#include <string>

#include "io/text_file.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::exports {
namespace {

using Way = RoadNetwork::Way;

/// Gives ids, which are unique over nodes, ways and relations, as Lanelet2 requires.
class Ids {
 public:
  explicit Ids(const RoadNetwork& network)
      : ways_(nodes_ + network.nodes.size()),
        lanelets_(ways_ + network.ways.size()),
        stops_(lanelets_ + network.lanelets.size()) {}
  std::size_t node(std::size_t i) const { return nodes_ + i; }
  std::size_t way(std::size_t i) const { return ways_ + i; }
  std::size_t lanelet(std::size_t i) const { return lanelets_ + i; }
  std::size_t stop(std::size_t i) const { return stops_ + i; }

 private:
  std::size_t nodes_ = 1, ways_, lanelets_, stops_;
};

pugi::xml_node add_element(pugi::xml_node& osm, const char* name, std::size_t id) {
  pugi::xml_node element = osm.append_child(name);
  element.append_attribute("id") = static_cast<unsigned long long>(id);
  element.append_attribute("visible") = "true";
  element.append_attribute("version") = 1;
  return element;
}

void add_tag(pugi::xml_node& element, const char* key, const std::string& value) {
  pugi::xml_node tag = element.append_child("tag");
  tag.append_attribute("k") = key;
  tag.append_attribute("v") = value.c_str();
}

void add_member(pugi::xml_node& relation, const char* type, const char* role, std::size_t id) {
  pugi::xml_node member = relation.append_child("member");
  member.append_attribute("type") = type;
  member.append_attribute("ref") = static_cast<unsigned long long>(id);
  member.append_attribute("role") = role;
}

void add_known(pugi::xml_node& element, const char* key, double value) {
  if (value >= 0.0) add_tag(element, key, fmt::format("{:.2f}", value));
}

void add_nodes(const RoadNetwork& network, const Ids& ids, const Origin& origin, pugi::xml_node& osm) {
  const GeographicLib::LocalCartesian earth(origin.latitude_deg, origin.longitude_deg, 0.0);
  for (std::size_t i = 0; i < network.nodes.size(); ++i) {
    const Point& point = network.nodes[i];
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    const Point offset = point - origin.of;
    earth.Reverse(offset.x(), offset.y(), offset.z(), latitude_deg, longitude_deg, height_m);
    pugi::xml_node node = add_element(osm, "node", ids.node(i));
    node.append_attribute("lat") = fmt::format("{:.11f}", latitude_deg).c_str();
    node.append_attribute("lon") = fmt::format("{:.11f}", longitude_deg).c_str();
    add_tag(node, "local_x", fmt::format("{:.4f}", point.x()));
    add_tag(node, "local_y", fmt::format("{:.4f}", point.y()));
    add_tag(node, "ele", fmt::format("{:.4f}", point.z()));
  }
}

void add_type(const Way& way, pugi::xml_node& element) {
  switch (way.kind) {
    case Way::Kind::laneline:
      add_tag(element, "type", "line_thin");
      if (way.style == MarkingStyle::solid) add_tag(element, "subtype", "solid");
      if (way.style == MarkingStyle::dashed) add_tag(element, "subtype", "dashed");
      return;
    case Way::Kind::roadedge:
      return add_tag(element, "type", "road_border");
    case Way::Kind::stopline:
      return add_tag(element, "type", "stop_line");
    case Way::Kind::virtual_line:
      return add_tag(element, "type", "virtual");
  }
}

void add_ways(const RoadNetwork& network, const Ids& ids, pugi::xml_node& osm) {
  for (std::size_t i = 0; i < network.ways.size(); ++i) {
    const Way& way = network.ways[i];
    pugi::xml_node element = add_element(osm, "way", ids.way(i));
    for (const std::size_t node : way.nodes)
      element.append_child("nd").append_attribute("ref") = static_cast<unsigned long long>(ids.node(node));
    add_type(way, element);
    add_known(element, "laneloom:existence", way.existence_probability);
    add_known(element, "laneloom:stddev_m", way.lateral_stddev_m);
  }
}

/// Whether a u-turn bends to the left.
bool bends_left(const RoadNetwork& network, const RoadNetwork::Lanelet& lanelet) {
  const auto at = [&](bool at_back) -> const Point& {
    return network.nodes[end_node(network, lanelet.left, at_back)];
  };
  const Point& right = network.nodes[end_node(network, lanelet.right, false)];
  return (at(true) - at(false)).head<2>().dot((at(false) - right).head<2>()) > 0.0;
}

std::string turn_direction(const RoadNetwork& network, const RoadNetwork::Lanelet& lanelet) {
  using Turn = Linkage::Turn;
  if (lanelet.turn == Turn::straight) return "straight";
  if (lanelet.turn == Turn::u_turn) return bends_left(network, lanelet) ? "left" : "right";
  return lanelet.turn == Turn::left ? "left" : "right";
}

/// Autoware's name of a shoulder is an extra. Lanelet2's own is another one. Neither has one of a parking
/// strip, where a vehicle may stop as well.
const char* subtype(const RoadNetwork::Lanelet& lanelet, bool extras) {
  if (!lanelet.is_side_strip()) return "road";
  if (lanelet.use == Lane::Use::cycle) return "bicycle_lane";
  return extras ? "road_shoulder" : "emergency_lane";
}

void add_lanelets(const RoadNetwork& network, const Ids& ids, bool extras, pugi::xml_node& osm) {
  for (std::size_t i = 0; i < network.lanelets.size(); ++i) {
    const RoadNetwork::Lanelet& lanelet = network.lanelets[i];
    pugi::xml_node relation = add_element(osm, "relation", ids.lanelet(i));
    add_member(relation, "way", "left", ids.way(lanelet.left.way));
    add_member(relation, "way", "right", ids.way(lanelet.right.way));
    for (std::size_t stop = 0; stop < network.stops.size(); ++stop)
      for (const std::size_t stopped : network.stops[stop].lanelets)
        if (stopped == i) add_member(relation, "relation", "regulatory_element", ids.stop(stop));
    add_tag(relation, "type", "lanelet");
    add_tag(relation, "subtype", subtype(lanelet, extras));
    add_tag(relation, "location", "urban");
    add_tag(relation, "one_way", lanelet.one_way ? "yes" : "no");
    if (!lanelet.is_side_strip()) add_tag(relation, "participant:vehicle", "yes");
    if (lanelet.use == Lane::Use::cycle) add_tag(relation, "participant:bicycle", "yes");
    if (lanelet.turn != Linkage::Turn::unknown)
      add_tag(relation, "turn_direction", turn_direction(network, lanelet));
    add_tag(relation, "laneloom:status", name(lanelet.status));
    add_known(relation, "laneloom:existence", lanelet.existence_probability);
  }
}

void add_stops(const RoadNetwork& network, const Ids& ids, pugi::xml_node& osm) {
  for (std::size_t i = 0; i < network.stops.size(); ++i) {
    if (network.stops[i].lanelets.empty()) continue;
    pugi::xml_node relation = add_element(osm, "relation", ids.stop(i));
    add_member(relation, "way", "refers", ids.way(network.stops[i].way));
    add_tag(relation, "type", "regulatory_element");
    add_tag(relation, "subtype", "road_marking");
  }
}

/// Removes the tags that Lanelet2 does not know.
void remove_extras(pugi::xml_node& osm) {
  const auto is_extra = [](const std::string_view key) {
    return key == "local_x" || key == "local_y" || key == "turn_direction" || key.starts_with("laneloom:");
  };
  for (pugi::xml_node element : osm.children())
    for (pugi::xml_node tag = element.child("tag"); tag;) {
      const pugi::xml_node next = tag.next_sibling("tag");
      if (is_extra(tag.attribute("k").value())) element.remove_child(tag);
      tag = next;
    }
}

}  // namespace

void write_lanelet2(const std::filesystem::path& path, const RoadNetwork& network, const Origin& origin,
                    bool extras) {
  pugi::xml_document document;
  pugi::xml_node osm = document.append_child("osm");
  osm.append_attribute("version") = "0.6";
  osm.append_attribute("generator") = "laneloom";
  pugi::xml_node info = osm.append_child("MetaInfo");
  info.append_attribute("format_version") = "1";
  info.append_attribute("map_version") = "1";
  const Ids ids(network);
  add_nodes(network, ids, origin, osm);
  add_ways(network, ids, osm);
  add_lanelets(network, ids, extras, osm);
  add_stops(network, ids, osm);
  if (!extras) remove_extras(osm);
  io::TextFile file(path);
  document.save(file.stream(), "  ");
  file.close();
}

}  // namespace laneloom::exports
