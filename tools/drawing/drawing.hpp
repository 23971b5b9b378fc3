#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drawing/palette.hpp"
#include "laneloom/types.hpp"

/// A list of things to draw, from maps, detections and truth. Pictures, the viewer, and scenes for other
/// programs are all made from it. All coordinates are in the map frame, in metres.
namespace laneloom::drawing {

/// A line through its points. It is closed only where it ends with its first point.
struct DrawnLine {
  Polyline points;  ///< at least two
};

/// The area between two lines of the same direction. If `right` is empty, `left` is the outline of a polygon.
struct DrawnArea {
  Polyline left;
  Polyline right;
};

/// The head of an arrow.
struct DrawnArrow {
  Point tip = Point::Zero();
  Point direction = Point::UnitX();  ///< unit length
};

/// A text for people.
struct DrawnText {
  Point position = Point::Zero();  ///< of its middle
  std::string text;
};

/// A form to draw, with its style.
struct Shape {
  std::variant<DrawnLine, DrawnArea, DrawnArrow, DrawnText> form;
  Style style = Style::id;
  double opacity = 1.0;  ///< 0..1, factor on the style's own
};

/// One thing of the map, of a frame or of the truth.
struct Element {
  Layer layer = Layer::boundaries;
  /// Names the element within the drawing. The same thing has the same key in the next drawing. Detections
  /// have no identity, and are numbered within their frame.
  std::string key;
  ElementId id = kNoElement;  ///< of the map's element; kNoElement: it has none
  std::string type;           ///< "laneline", "roadedge", "stopline", "lane", "linkage", …
  std::optional<ElementStatus> status;
  nlohmann::json properties = nlohmann::json::object();  ///< further knowledge of it, for people
  std::vector<Shape> shapes;                             ///< in the order of painting; at least one
};

/// Not thread-safe.
class Drawing {
 public:
  std::int64_t stamp_ns = 0;  ///< stamp of the things that it shows
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::vector<LineageEvent> lineage;  ///< since the map before

  /// Adds an element. An element without a shape is left out.
  void add(Element element);
  /// All elements in the order of painting: by layer, and within a layer as they were added.
  const std::vector<Element>& elements() const { return elements_; }

 private:
  std::vector<Element> elements_;
};

}  // namespace laneloom::drawing
