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

}  // namespace laneloom::sd_map
