#pragma once

#include "laneloom/types.hpp"
#include "render/canvas.hpp"

/// The paper's colours: red lanelines, green roadedges, blue stoplines, magenta linkages.
namespace laneloom::palette {

inline constexpr Colour kLaneline{0.83, 0.07, 0.09};
inline constexpr Colour kRoadedge{0.07, 0.50, 0.16};
inline constexpr Colour kStopline{0.08, 0.20, 0.86};
inline constexpr Colour kLinkage{0.80, 0.00, 0.75};
inline constexpr Colour kTruth{0.60, 0.60, 0.60};
inline constexpr Colour kText{0.15, 0.15, 0.18};
inline constexpr Colour kFaint{0.45, 0.45, 0.50};
inline constexpr Colour kVehicle{0.22, 0.24, 0.30};
inline constexpr Colour kGround{0.975, 0.975, 0.965};
inline constexpr Colour kBox{0.55, 0.58, 0.66};
/// Neighbouring lanes get different ones.
inline constexpr std::array<Colour, 4> kLanes{Colour{0.25, 0.52, 0.86, 0.20}, Colour{0.95, 0.68, 0.15, 0.22},
                                              Colour{0.30, 0.68, 0.55, 0.20}, Colour{0.58, 0.42, 0.80, 0.18}};

constexpr const Colour& of(MarkingType type) {
  return type == MarkingType::laneline ? kLaneline : type == MarkingType::roadedge ? kRoadedge : kStopline;
}

/// Dashed as painted; where the style is unknown: thin.
inline Pen marking_pen(MarkingType type, MarkingStyle style) {
  if (type == MarkingType::stopline) return {of(type), 4.0, {}};
  if (type == MarkingType::roadedge) return {of(type), 2.4, {}};
  if (style == MarkingStyle::dashed) return {of(type), 2.2, {9.0, 7.0}};
  return {of(type), style == MarkingStyle::solid ? 2.2 : 1.1, {}};
}

}  // namespace laneloom::palette
