#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drawing/palette.hpp"
#include "laneloom/types.hpp"

/// One list of what there is to draw, from maps, detections and truth, for everyone who draws: pictures, the
/// viewer, scenes of other programs. All coordinates are in the map frame, in metres.
namespace laneloom {

struct DrawnLine {
  Polyline points;  ///< at least two
};

/// What is between two lines of the same direction, or a polygon: then `right` is empty.
struct DrawnArea {
  Polyline left;
  Polyline right;
};

/// Only the arrow's head.
struct DrawnArrow {
  Point tip = Point::Zero();
  Point direction = Point::UnitX();  ///< unit length
};

struct DrawnText {
  Point position = Point::Zero();  ///< of its middle
  std::string text;
};

struct Shape {
  std::variant<DrawnLine, DrawnArea, DrawnArrow, DrawnText> form;
  Style style = Style::id;
  double opacity = 1.0;  ///< on top of the style's own
};

/// One thing of the map, of a frame or of the truth.
struct Element {
  Layer layer = Layer::boundaries;
  /// No other element of the drawing has it. The same thing has it in the next drawing, too; detections have
  /// no identity, and are numbered within their frame.
  std::string key;
  ElementId id = kNoElement;  ///< of the map's element; none: it has no id
  std::string type;           ///< "laneline", "roadedge", "stopline", "lane", "linkage", …
  std::optional<ElementStatus> status;
  nlohmann::json properties = nlohmann::json::object();  ///< what else is known of it, for people
  std::vector<Shape> shapes;                             ///< in the order of painting; at least one
};

/// Not thread-safe.
class Drawing {
 public:
  std::int64_t stamp_ns = 0;  ///< of what it shows
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::vector<LineageEvent> lineage;  ///< since the map before

  /// What has no shape is left out.
  void add(Element element);
  /// In the order of painting: by layer, within a layer as they were added.
  const std::vector<Element>& elements() const { return elements_; }

 private:
  std::vector<Element> elements_;
};

}  // namespace laneloom
