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
constexpr Colour kObject{0.00, 0.42, 0.48, 0.75}, kDarkObject{0.35, 0.82, 0.88, 0.80};
constexpr Colour kTrail{0.00, 0.48, 0.55, 0.60}, kDarkTrail{0.30, 0.88, 0.95, 0.50};
constexpr Colour kWindow{0.80, 0.86, 0.93}, kDarkWindow{0.20, 0.26, 0.33};
// By LaneRole. The own lane stands out; the others are as strong as they matter to a driver.
constexpr std::array kLanes{Colour{0.10, 0.45, 0.95, 0.34}, Colour{0.25, 0.58, 0.82, 0.16},
                            Colour{0.62, 0.32, 0.80, 0.20}, Colour{0.20, 0.62, 0.52, 0.18},
                            Colour{0.50, 0.52, 0.56, 0.20}, Colour{0.50, 0.44, 0.34, 0.30}};
constexpr Colour kInferred{0.20, 0.22, 0.28, 0.35}, kDarkInferred{0.90, 0.92, 1.00, 0.35};

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
  return area(name, kLanes[i], kLanes[i].faded(i == 0 ? 1.2 : 1.8));  // the own lane is strong already
}
constexpr StyleSpec arrow(StyleSpec spec, double head) {
  spec.head = head;
  return spec;
}
constexpr StyleSpec course(const char* name, std::size_t i) {
  return arrow(dashed(line(name, darker(kLanes[i]), brighter(kLanes[i]), 0.8), 2.0, 4.0), 9.0);
}
constexpr StyleSpec id() { return {.name = "id", .light = kText, .dark = kDarkText, .text = 11.0}; }

// In the order of Style.
constexpr std::array<StyleSpec, kStyleCount> kStyles{
    line("laneline_solid", kLaneline, kDarkLaneline, 2.2),
    dashed(line("laneline_dashed", kLaneline, kDarkLaneline, 2.2), 9.0, 7.0),
    line("laneline_unknown", kLaneline, kDarkLaneline, 1.1),
    line("roadedge", kRoadedge, kDarkRoadedge, 2.4),
    line("stopline", kStopline, kDarkStopline, 4.0),
    lane("lane_own", 0),
    lane("lane_same_way", 1),
    lane("lane_oncoming", 2),
    lane("lane_crossing", 3),
    lane("lane_unknown", 4),
    lane("lane_unused", 5),
    course("course_own", 0),
    course("course_same_way", 1),
    course("course_oncoming", 2),
    course("course_crossing", 3),
    course("course_unknown", 4),
    course("course_unused", 5),
    line("inferred", kInferred, kDarkInferred, 1.0),
    arrow(line("linkage", kLinkage, kDarkLinkage, 1.8), 9.0),
    line("way", kWay, kDarkWay, 3.0),
    line("truth", kTruth, kDarkTruth, 1.0),
    area("field_of_view", {0.35, 0.55, 0.75, 0.07}, {0.55, 0.75, 0.95, 0.07}),
    area("occlusion", {0.20, 0.20, 0.25, 0.16}, {0.00, 0.00, 0.00, 0.45}),
    area("uncertainty", {0.90, 0.45, 0.05, 0.20}, {1.00, 0.65, 0.25, 0.22}),
    dashed(line("range", kBox, kBox, 0.9), 5.0, 4.0),
    area("vehicle", kVehicle, kDarkVehicle),
    area("window", kWindow, kDarkWindow),
    area("object", kObject, kDarkObject),
    arrow(line("trail", kTrail, kDarkTrail, 1.2), 8.0),
    arrow(line("driven", kTrail, kDarkTrail, 3.0), 11.0),
    arrow(line("told", kObject, kDarkObject, 0.0), 15.0),
    id()};

// In the order of Layer.
constexpr std::array<LayerSpec, kLayerCount> kLayers{
    LayerSpec{.name = "field_of_view", .title = "field of view", .sample = Style::field_of_view},
    LayerSpec{.name = "occlusions", .title = "occluded areas", .sample = Style::occlusion},
    LayerSpec{.name = "lanes", .title = "lanes", .sample = Style::lane_own},
    LayerSpec{.name = "truth", .title = "ground truth", .sample = Style::truth},
    LayerSpec{.name = "range", .title = "map range", .sample = Style::range},
    LayerSpec{.name = "uncertainty", .title = "uncertainty (2 σ)", .sample = Style::uncertainty},
    LayerSpec{
        .name = "markings", .title = "fused markings", .sample = Style::laneline_unknown, .shown = false},
    LayerSpec{.name = "boundaries", .title = "lane boundaries", .sample = Style::laneline_solid},
    LayerSpec{.name = "stoplines", .title = "stop lines", .sample = Style::stopline},
    LayerSpec{.name = "linkages", .title = "linkages", .sample = Style::linkage},
    LayerSpec{.name = "way", .title = "own way", .sample = Style::way},
    LayerSpec{.name = "traffic", .title = "other vehicles", .sample = Style::trail},
    LayerSpec{
        .name = "detections", .title = "detections", .sample = Style::laneline_unknown, .overlay = 0.55},
    LayerSpec{.name = "ids", .title = "ids", .sample = Style::id, .shown = false},
    LayerSpec{.name = "vehicle", .title = "vehicle", .sample = Style::vehicle}};

constexpr std::array kLegend{LegendEntry{Style::laneline_solid, "solid line"},
                             LegendEntry{Style::laneline_dashed, "dashed line"},
                             LegendEntry{Style::laneline_unknown, "unknown style"},
                             LegendEntry{Style::roadedge, "road edge"},
                             LegendEntry{Style::stopline, "stop line"},
                             LegendEntry{Style::lane_own, "own lane"},
                             LegendEntry{Style::lane_same_way, "same direction"},
                             LegendEntry{Style::lane_oncoming, "oncoming"},
                             LegendEntry{Style::lane_crossing, "crossing"},
                             LegendEntry{Style::lane_unknown, "direction unknown"},
                             LegendEntry{Style::lane_unused, "side strip"},
                             LegendEntry{Style::inferred, "inferred"},
                             LegendEntry{Style::way, "own way"},
                             LegendEntry{Style::linkage, "linkage"},
                             LegendEntry{Style::truth, "ground truth"},
                             LegendEntry{Style::range, "map range"}};
constexpr std::array kTrafficLegend{
    LegendEntry{Style::object, "other vehicle"}, LegendEntry{Style::trail, "its trail"},
    LegendEntry{Style::driven, "driven, no lane"}, LegendEntry{Style::told, "told by trails"}};

Style of_role(Style first, LaneRole role) {
  return static_cast<Style>(static_cast<std::size_t>(first) + static_cast<std::size_t>(role));
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

Style lane_style(LaneRole role) { return of_role(Style::lane_own, role); }
Style course_style(LaneRole role) { return of_role(Style::course_own, role); }
std::span<const LegendEntry> legend() { return kLegend; }
std::span<const LegendEntry> traffic_legend() { return kTrafficLegend; }

}  // namespace laneloom::drawing::palette
