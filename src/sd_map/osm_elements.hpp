#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>

/// Elements of OpenStreetMap's XML, which Lanelet2 uses as well.
namespace laneloom::sd_map {

using OsmId = std::int64_t;

/// The value of a tag. Empty: the element has no such tag.
inline std::string_view tag(const pugi::xml_node& element, const char* key) {
  return element.find_child_by_attribute("tag", "k", key).attribute("v").as_string();
}

inline OsmId id_of(const pugi::xml_node& element, const char* attribute = "id") {
  return element.attribute(attribute).as_llong();
}

/// The element's kind and id, for complaints.
inline std::string name_of(const pugi::xml_node& element) {
  return std::string(element.name()) + " " + element.attribute("id").as_string();
}

/// Removes the elements that are deleted. Editors (JOSM) keep them in the file until it is uploaded.
inline void remove_deleted(pugi::xml_node osm) {
  for (pugi::xml_node element = osm.first_child(); element;) {
    const pugi::xml_node next = element.next_sibling();
    if (std::string_view(element.attribute("action").as_string()) == "delete" ||
        !element.attribute("visible").as_bool(true))
      osm.remove_child(element);
    element = next;
  }
}

}  // namespace laneloom::sd_map
