#pragma once

#include <map>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/left_out.hpp"
#include "sd_map/osm_elements.hpp"
#include "simulation/road.hpp"

/// Nodes and ways of a Lanelet2 map. What is wrong is left out.
namespace laneloom::simulation {

/// An element is wrong. `detail` is what differs between errors of one kind.
class BadElement : public std::runtime_error {
 public:
  BadElement(const pugi::xml_node& element, const std::string& complaint, const std::string& detail)
      : std::runtime_error(sd_map::name_of(element) + ": " + complaint + detail),
        reason_("a " + std::string(element.name()) + " that " + complaint),
        place_(sd_map::name_of(element)) {}
  const std::string& reason() const { return reason_; }
  const std::string& place() const { return place_; }

 private:
  std::string reason_, place_;
};

[[noreturn]] inline void refuse(const pugi::xml_node& element, const std::string& complaint,
                                const std::string& detail = {}) {
  throw BadElement(element, complaint, detail);
}

/// Reads the elements of a kind. Those that are wrong are left out.
template <typename Read>
void for_each_element(const pugi::xml_node& osm, const char* kind, LeftOut& left_out, Read read) {
  for (const pugi::xml_node& element : osm.children(kind)) {
    try {
      read(element);
    } catch (const BadElement& error) {
      if (left_out.strict()) throw;
      left_out.add(error.reason(), error.place());
    }
  }
}

/// A line of the map.
struct Way {
  std::vector<sd_map::OsmId> nodes{};
  Polyline points{};
  ElementId marking = kNoElement;
  bool is_virtual = false;
};

/// The places of the nodes, in metres.
std::map<sd_map::OsmId, Point> read_nodes(const pugi::xml_node& osm, LeftOut& left_out);

/// Reads the ways, and emits their markings.
std::map<sd_map::OsmId, Way> read_ways(const pugi::xml_node& osm, const std::map<sd_map::OsmId, Point>& nodes,
                                       Road& road, LeftOut& left_out);

}  // namespace laneloom::simulation
