#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drawing/colour.hpp"
#include "laneloom/types.hpp"

/// The colours and strokes of all pictures, of the viewer and of other programs' scenes. They are defined
/// nowhere else. The hues are the paper's: red lanelines, green roadedges, blue stoplines, magenta linkages.
namespace laneloom::drawing {

/// The look of a drawn shape. Pictures have a light ground; viewers may have a dark one.
enum class Style : std::uint8_t {
  laneline_solid,
  laneline_dashed,
  laneline_unknown,
  roadedge,
  stopline,
  lane_a,  ///< one of four colours of lanes, so that neighbours differ
  lane_b,
  lane_c,
  lane_d,
  course_a,  ///< centerline and arrows of a lane_a
  course_b,
  course_c,
  course_d,
  linkage,
  way,  ///< the own way
  truth,
  field_of_view,
  occlusion,
  uncertainty,
  range,
  vehicle,
  window,  ///< of the vehicle
  id
};
inline constexpr std::size_t kStyleCount = 23;
inline constexpr std::size_t kLaneStyles = 4;

/// A group of elements that can be shown or hidden together. Layers are painted in this order; the first lies
/// lowest.
enum class Layer : std::uint8_t {
  field_of_view,
  occlusions,
  lanes,
  truth,
  range,
  uncertainty,
  markings,
  boundaries,
  stoplines,
  linkages,
  way,
  detections,
  ids,
  vehicle
};
inline constexpr std::size_t kLayerCount = 14;

namespace palette {

inline constexpr Colour kText{0.15, 0.15, 0.18};
inline constexpr Colour kFaint{0.45, 0.45, 0.50};
inline constexpr Colour kGround{0.975, 0.975, 0.965};
inline constexpr Colour kBox{0.55, 0.58, 0.66};
inline constexpr Colour kDarkText{0.90, 0.90, 0.92};
inline constexpr Colour kDarkFaint{0.62, 0.63, 0.68};
inline constexpr Colour kDarkGround{0.09, 0.10, 0.12};

/// The values of a style, in pixels of a screen.
struct StyleSpec {
  const char* name;
  Colour light;           ///< on a light ground
  Colour dark;            ///< on a dark ground
  double width = 0.0;     ///< of a line; 0: it is not for lines
  double dash_on = 0.0;   ///< 0: solid
  double dash_off = 0.0;  ///< between two dashes
  double head = 0.0;      ///< length of an arrow's head; 0: it is not for arrows
  double text = 0.0;      ///< height of a text; 0: it is not for texts
};

/// The name of a layer, and how viewers show it.
struct LayerSpec {
  const char* name;
  const char* title;     ///< for people
  bool shown = true;     ///< whether a viewer shows it at first
  double overlay = 1.0;  ///< factor on widths of lines in viewers that lay it over the fused map
};

const palette::StyleSpec& of(Style style);
const palette::LayerSpec& of(Layer layer);

/// The style of a marking: dashed if it is painted so, thin if its style is unknown.
Style marking_style(MarkingType type, MarkingStyle style);
/// The style of a lane's area. It stays the same as long as the lane keeps its id.
Style lane_style(ElementId lane);
/// The style of a lane's centerline and arrows.
Style course_style(ElementId lane);

}  // namespace palette
}  // namespace laneloom::drawing
