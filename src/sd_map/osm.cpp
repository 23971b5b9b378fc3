#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "sd_map/osm.hpp"
#include "sd_map/osm_elements.hpp"

namespace laneloom::sd_map {
namespace {

/// Values of the tag highway of streets for motor vehicles. Their links have the suffix "_link".
const std::set<std::string_view> kStreets{"motorway", "trunk",        "primary",     "secondary",
                                          "tertiary", "unclassified", "residential", "living_street",
                                          "service",  "road"};
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMaxDistance_m = 1e6;  // from the origin; further away the projection has no meaning
constexpr std::uintmax_t kMaxFileBytes = 128U << 20U;  // in memory a file takes five to eight times as much
constexpr int kMaxLanes = 30;
constexpr double kMaxStreets_m = 2e7;  // all streets; a few bytes can name streets that take all memory

/// What a file is that is no XML, by its first bytes. Empty: nothing known.
std::string_view other_kind(const std::string& file) {
  std::array<char, 32> bytes{};
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(in.gcount()));
  if (begin.empty()) return "is empty";
  if (begin.starts_with("\x1f\x8b")) return "is compressed with gzip";
  if (begin.starts_with("BZh")) return "is compressed with bzip2";
  if (begin.find("OSMHeader") != std::string_view::npos) return "is an extract as PBF";
  if (begin.starts_with('{') || begin.starts_with('[')) return "is JSON";
  return {};
}

[[noreturn]] void refuse(const pugi::xml_node& element, const std::string& complaint) {
  throw std::runtime_error(name_of(element) + " " + complaint);
}

/// The degrees that an attribute has. Not finite: it has none.
double degrees(const pugi::xml_attribute& attribute) {
  const std::string_view text = attribute.as_string();
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : kNone;
}

/// The places of nodes. Those of nodes without one are not finite.
std::map<OsmId, Eigen::Vector2d> read_nodes(const pugi::xml_node& osm, const SdMapConfig& config) {
  const GeographicLib::LocalCartesian projection(config.origin_latitude_deg, config.origin_longitude_deg);
  std::map<OsmId, Eigen::Vector2d> nodes;
  for (const pugi::xml_node& node : osm.children("node")) {
    const double lat_deg = degrees(node.attribute("lat")), lon_deg = degrees(node.attribute("lon"));
    if (!(std::abs(lat_deg) <= 90.0) || !(std::abs(lon_deg) <= 180.0)) {
      nodes.emplace(id_of(node), Eigen::Vector2d::Constant(kNone));
      continue;
    }
    double east_m = 0.0, north_m = 0.0, up_m = 0.0;
    projection.Forward(lat_deg, lon_deg, 0.0, east_m, north_m, up_m);
    if (std::hypot(east_m, north_m) <= kMaxDistance_m)
      nodes.emplace(id_of(node), Eigen::Vector2d(east_m, north_m));
  }
  return nodes;
}

bool is_street(const pugi::xml_node& way) {
  std::string_view highway = tag(way, "highway");
  if (highway.ends_with("_link")) highway.remove_suffix(std::string_view("_link").size());
  return kStreets.contains(highway);
}

/// The number of lanes that the tag lanes tells. 0: it tells none, or none that a street can have.
int lanes_of(const pugi::xml_node& way) {
  const std::string_view text = tag(way, "lanes");
  int lanes = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), lanes);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && lanes > 0 && lanes <= kMaxLanes ? lanes : 0;
}

/// Adds the parts of a way whose nodes are in the extract.
void add_way(const pugi::xml_node& element, const std::map<OsmId, Eigen::Vector2d>& nodes,
             std::vector<SdWay>& ways) {
  const std::string_view oneway = tag(element, "oneway"), junction = tag(element, "junction");
  SdWay way{.id = id_of(element),
            .nodes = {},
            .points = {},
            .oneway = oneway == "yes" || oneway == "1" || oneway == "true" || oneway == "-1" ||
                      (oneway.empty() && (junction == "roundabout" || tag(element, "highway") == "motorway")),
            .lanes = lanes_of(element)};
  const auto finish = [&] {
    if (way.nodes.size() >= 2) ways.push_back(way);
    way.nodes.clear();
    way.points.clear();
  };
  std::vector<OsmId> refs;
  for (const pugi::xml_node& nd : element.children("nd")) refs.push_back(id_of(nd, "ref"));
  if (oneway == "-1") std::ranges::reverse(refs);
  for (const OsmId ref : refs) {
    const auto node = nodes.find(ref);
    if (node == nodes.end()) {
      finish();
      continue;
    }
    if (!node->second.allFinite())
      refuse(element, "has node " + std::to_string(ref) + ", which has no latitude and longitude in degrees");
    way.nodes.push_back(ref);
    way.points.push_back(node->second);
  }
  finish();
}

double total_length_m(const std::vector<SdWay>& ways) {
  double total_m = 0.0;
  for (const SdWay& way : ways)
    for (std::size_t i = 1; i < way.points.size(); ++i) total_m += (way.points[i] - way.points[i - 1]).norm();
  return total_m;
}

/// The turn restriction of a relation at a single node. Empty: it is another one, or holds for some vehicles
/// or hours only.
std::optional<SdRestriction> restriction(const pugi::xml_node& relation) {
  if (tag(relation, "type") != "restriction") return std::nullopt;
  const std::string_view kind = tag(relation, "restriction");
  if (!kind.starts_with("no_") && !kind.starts_with("only_")) return std::nullopt;
  std::optional<OsmId> from, via, to;
  for (const pugi::xml_node& member : relation.children("member")) {
    const std::string_view role = member.attribute("role").as_string();
    const std::string_view type = member.attribute("type").as_string();
    if (role == "from" && type == "way") from = id_of(member, "ref");
    if (role == "to" && type == "way") to = id_of(member, "ref");
    if (role == "via" && type == "node") via = id_of(member, "ref");
  }
  // An about turn is never driven. Forbidden on a way that goes on beyond the node, it would forbid to go
  // straight on.
  const bool about_turn = from == to;
  if (!from || !via || !to || about_turn) return std::nullopt;
  return SdRestriction{*from, *via, *to, kind.starts_with("only_")};
}

/// Loads a file. Returns its element osm.
pugi::xml_node load_osm(const std::string& file, pugi::xml_document& document) {
  const auto refuse_other = [](std::string_view kind) {
    throw std::runtime_error(std::string(kind) + "; an extract as OSM XML (.osm) is needed");
  };
  if (const std::string_view kind = other_kind(file); !kind.empty()) refuse_other(kind);
  const auto result = document.load_file(file.c_str());
  if (result.status == pugi::status_no_document_element) refuse_other("is no XML");
  if (!result)
    throw std::runtime_error(std::string(result.description()) + " at byte " + std::to_string(result.offset));
  const pugi::xml_node osm = document.child("osm");
  if (!osm) refuse_other("has no element osm");
  return osm;
}

SdMap read(const std::string& file, const SdMapConfig& config) {
  pugi::xml_document document;
  const pugi::xml_node osm = load_osm(file, document);
  remove_deleted(osm);
  const auto nodes = read_nodes(osm, config);
  std::vector<SdWay> ways;
  for (const pugi::xml_node& way : osm.children("way"))
    if (is_street(way)) add_way(way, nodes, ways);
  if (ways.empty()) throw std::runtime_error("has no street within 1000 km of the configured origin");
  if (total_length_m(ways) > kMaxStreets_m) throw std::runtime_error("has more than 20000 km of streets");
  std::vector<SdRestriction> restrictions;
  for (const pugi::xml_node& relation : osm.children("relation"))
    if (const auto found = restriction(relation)) restrictions.push_back(*found);
  return {std::move(ways), restrictions};
}

}  // namespace

// Opening a pipe would wait for its writer.
void check_sd_map_file(const SdMapConfig& config) {
  std::error_code error;
  if (config.file.empty()) return;
  if (!std::filesystem::is_regular_file(config.file, error))
    throw ConfigError(config.file + ": is not a readable file");
  if (std::filesystem::file_size(config.file, error) > kMaxFileBytes)
    throw ConfigError(config.file + ": is larger than 128 MB");
}

SdMap load_sd_map(const SdMapConfig& config) {
  if (config.file.empty()) return {};
  check_sd_map_file(config);
  try {
    return read(config.file, config);
  } catch (const std::exception& error) {
    throw ConfigError(config.file + ": " + error.what());
  }
}

}  // namespace laneloom::sd_map
