#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "VisualizationMsgs.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::ros2 {

/// The map as markers for RViz and Foxglove. An element keeps its marker's namespace and id for as long as it
/// is in the map, so that nothing flickers. The marker of an element that leaves the map is deleted once. A
/// marker that is not repeated disappears after a second, so that the display of a service that hangs becomes
/// empty. Not thread-safe.
class Markers {
 public:
  /// Markers of all elements of the map, and deletions of those that left it since the call before.
  /// Coordinates are in the map frame.
  visualization_msgs::msg::dds_::MarkerArray_ update(const PublishedMap& map);

 private:
  using Marker = visualization_msgs::msg::dds_::Marker_;

  /// An element of the map. A linkage has two ids: those of its lanes.
  struct Element {
    std::string ns;  ///< namespace of the marker
    ElementId id = kNoElement, other = kNoElement;
    bool operator<(const Element& o) const { return std::tie(ns, id, other) < std::tie(o.ns, o.id, o.other); }
  };
  /// A marker that viewers show.
  struct Shown {
    std::int32_t id = 0;       ///< of the marker
    std::uint64_t update = 0;  ///< number of the newest update that had it
  };

  /// A new marker of an element, without any shape.
  Marker& add(const PublishedMap& map, const Element& element);
  void add_boundaries(const PublishedMap& map);
  void add_lanes(const PublishedMap& map);
  void add_stoplines(const PublishedMap& map);
  void add_linkages(const PublishedMap& map);
  void add_way(const PublishedMap& map);
  void add_state(const PublishedMap& map);
  void delete_gone(const PublishedMap& map);

  std::map<Element, Shown> shown_;
  std::int32_t next_id_ = 0;
  std::uint64_t updates_ = 0;
  std::vector<Marker> markers_;  ///< of the present update
};

}  // namespace laneloom::ros2
