#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drawing/colour.hpp"
#include "drawing/lane_role.hpp"
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
  lane_own,  ///< lanes by their LaneRole, in its order
  lane_same_way,
  lane_oncoming,
  lane_crossing,
  lane_unknown,
  lane_unused,
  course_own,  ///< centerlines and arrows of lanes, in the same order
  course_same_way,
  course_oncoming,
  course_crossing,
  course_unknown,
  course_unused,
  inferred,  ///< hatching of the stretches of a lane that were concluded
  linkage,
  way,  ///< the own way
  truth,
  field_of_view,
  occlusion,
  uncertainty,
  range,
  vehicle,
  window,  ///< of the vehicle
  object,  ///< another vehicle, or what else a tracker follows
  trail,   ///< the way that another vehicle drove
  driven,  ///< where others drove and no lane is
  told,    ///< arrows of a lane whose direction was told by trails
  id
};
inline constexpr std::size_t kStyleCount = 32;

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
  traffic,
  detections,
  ids,
  vehicle
};
inline constexpr std::size_t kLayerCount = 15;

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
  Style sample;          ///< the style that stands for it in a legend
  bool shown = true;     ///< whether a viewer shows it at first
  double overlay = 1.0;  ///< factor on widths of lines in viewers that lay it over the fused map
};

/// A style with its meaning for people.
struct LegendEntry {
  Style style;
  const char* title;
};

const palette::StyleSpec& of(Style style);
const palette::LayerSpec& of(Layer layer);

/// The style of a marking: dashed if it is painted so, thin if its style is unknown.
Style marking_style(MarkingType type, MarkingStyle style);
/// The style of a lane's area.
Style lane_style(LaneRole role);
/// The style of a lane's centerline and arrows.
Style course_style(LaneRole role);
/// The styles of maps that a legend explains, in its order.
std::span<const LegendEntry> legend();
/// Likewise those of other vehicles, which viewers show and pictures do not.
std::span<const LegendEntry> traffic_legend();

}  // namespace palette
}  // namespace laneloom::drawing
