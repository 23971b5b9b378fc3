#include "drawing/palette.hpp"

namespace laneloom::drawing::palette {
namespace {

constexpr Colour kLaneline{0.83, 0.07, 0.09}, kDarkLaneline{1.00, 0.40, 0.38};
constexpr Colour kRoadedge{0.07, 0.50, 0.16}, kDarkRoadedge{0.36, 0.80, 0.42};
constexpr Colour kStopline{0.08, 0.20, 0.86}, kDarkStopline{0.47, 0.62, 1.00};
constexpr Colour kLinkage{0.80, 0.00, 0.75}, kDarkLinkage{1.00, 0.45, 0.95};
constexpr Colour kWay{0.95, 0.45, 0.00, 0.75}, kDarkWay{1.00, 0.70, 0.20, 0.80};
constexpr Colour kTruth{0.60, 0.60, 0.60}, kDarkTruth{0.58, 0.58, 0.60};
constexpr Colour kVehicle{0.22, 0.24, 0.30, 0.90}, kDarkVehicle{0.78, 0.80, 0.85, 0.95};
constexpr Colour kWindow{0.80, 0.86, 0.93}, kDarkWindow{0.20, 0.26, 0.33};
constexpr std::array kLanes{Colour{0.25, 0.52, 0.86, 0.20}, Colour{0.95, 0.68, 0.15, 0.22},
                            Colour{0.30, 0.68, 0.55, 0.20}, Colour{0.58, 0.42, 0.80, 0.18}};

constexpr Colour darker(const Colour& colour) {
  return {colour.red * 0.6, colour.green * 0.6, colour.blue * 0.6, 0.9};
}
constexpr Colour brighter(const Colour& colour) {
  return {0.4 + colour.red * 0.6, 0.4 + colour.green * 0.6, 0.4 + colour.blue * 0.6, 0.9};
}

constexpr StyleSpec line(const char* name, const Colour& light, const Colour& dark, double width) {
  return {.name = name, .light = light, .dark = dark, .width = width};
}
constexpr StyleSpec dashed(StyleSpec spec, double on, double off) {
  spec.dash_on = on;
  spec.dash_off = off;
  return spec;
}
constexpr StyleSpec area(const char* name, const Colour& light, const Colour& dark) {
  return {.name = name, .light = light, .dark = dark};
}
constexpr StyleSpec lane(const char* name, std::size_t i) {
  return area(name, kLanes[i], kLanes[i].faded(1.2));
}
constexpr StyleSpec course(const char* name, std::size_t i) {
  StyleSpec spec = dashed(line(name, darker(kLanes[i]), brighter(kLanes[i]), 0.8), 2.0, 4.0);
  spec.head = 9.0;
  return spec;
}
constexpr StyleSpec linkage() {
  StyleSpec spec = line("linkage", kLinkage, kDarkLinkage, 1.8);
  spec.head = 9.0;
  return spec;
}
constexpr StyleSpec id() { return {.name = "id", .light = kText, .dark = kDarkText, .text = 11.0}; }

// In the order of Style.
constexpr std::array<StyleSpec, kStyleCount> kStyles{
    line("laneline_solid", kLaneline, kDarkLaneline, 2.2),
    dashed(line("laneline_dashed", kLaneline, kDarkLaneline, 2.2), 9.0, 7.0),
    line("laneline_unknown", kLaneline, kDarkLaneline, 1.1),
    line("roadedge", kRoadedge, kDarkRoadedge, 2.4),
    line("stopline", kStopline, kDarkStopline, 4.0),
    lane("lane_a", 0),
    lane("lane_b", 1),
    lane("lane_c", 2),
    lane("lane_d", 3),
    course("course_a", 0),
    course("course_b", 1),
    course("course_c", 2),
    course("course_d", 3),
    linkage(),
    line("way", kWay, kDarkWay, 3.0),
    line("truth", kTruth, kDarkTruth, 1.0),
    area("field_of_view", {0.35, 0.55, 0.75, 0.07}, {0.55, 0.75, 0.95, 0.07}),
    area("occlusion", {0.20, 0.20, 0.25, 0.16}, {0.00, 0.00, 0.00, 0.45}),
    area("uncertainty", {0.90, 0.45, 0.05, 0.28}, {1.00, 0.65, 0.25, 0.32}),
    dashed(line("range", kBox, kBox, 0.9), 5.0, 4.0),
    area("vehicle", kVehicle, kDarkVehicle),
    area("window", kWindow, kDarkWindow),
    id()};

// In the order of Layer.
constexpr std::array<LayerSpec, kLayerCount> kLayers{
    LayerSpec{.name = "field_of_view", .title = "field of view"},
    LayerSpec{.name = "occlusions", .title = "occluded areas"},
    LayerSpec{.name = "lanes", .title = "lanes"},
    LayerSpec{.name = "truth", .title = "ground truth"},
    LayerSpec{.name = "range", .title = "map range"},
    LayerSpec{.name = "uncertainty", .title = "uncertainty (2 σ)"},
    LayerSpec{.name = "markings", .title = "fused markings", .shown = false},
    LayerSpec{.name = "boundaries", .title = "lane boundaries"},
    LayerSpec{.name = "stoplines", .title = "stop lines"},
    LayerSpec{.name = "linkages", .title = "linkages"},
    LayerSpec{.name = "way", .title = "own way"},
    LayerSpec{.name = "detections", .title = "detections", .overlay = 0.55},
    LayerSpec{.name = "ids", .title = "ids", .shown = false},
    LayerSpec{.name = "vehicle", .title = "vehicle"}};

Style nth(Style first, ElementId id) {
  return static_cast<Style>(static_cast<std::size_t>(first) + id % kLaneStyles);
}

}  // namespace

const StyleSpec& of(Style style) { return kStyles.at(static_cast<std::size_t>(style)); }
const LayerSpec& of(Layer layer) { return kLayers.at(static_cast<std::size_t>(layer)); }

Style marking_style(MarkingType type, MarkingStyle style) {
  if (type == MarkingType::stopline) return Style::stopline;
  if (type == MarkingType::roadedge) return Style::roadedge;
  if (style == MarkingStyle::dashed) return Style::laneline_dashed;
  return style == MarkingStyle::solid ? Style::laneline_solid : Style::laneline_unknown;
}

Style lane_style(ElementId lane) { return nth(Style::lane_a, lane); }
Style course_style(ElementId lane) { return nth(Style::course_a, lane); }

}  // namespace laneloom::drawing::palette
