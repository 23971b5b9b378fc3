#include "drawing/drawing_json.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "drawing/properties.hpp"
#include "laneloom/element_names.hpp"

namespace laneloom::drawing {
namespace {

using nlohmann::json;

double rounded_to_cm(double value_m) { return std::round(value_m * 1e2) / 1e2; }

void append(const Point& point, json& to) {
  to.push_back(rounded_to_cm(point.x()));
  to.push_back(rounded_to_cm(point.y()));
}

json flat(const Polyline& line) {
  json out = json::array();
  for (const Point& point : line) append(point, out);
  return out;
}

void put(const DrawnLine& line, json& out) { out["line"] = flat(line.points); }

void put(const DrawnArea& area, json& out) {
  json outline = flat(area.left);
  for (auto point = area.right.rbegin(); point != area.right.rend(); ++point) append(*point, outline);
  out["area"] = std::move(outline);
}

void put(const DrawnArrow& arrow, json& out) {
  json& values = out["arrow"] = json::array();
  append(arrow.tip, values);
  values.push_back(rounded(std::atan2(arrow.direction.y(), arrow.direction.x())));
}

void put(const DrawnText& text, json& out) {
  out["text"] = text.text;
  out["at"] = flat({text.position});
}

json to_json(const Shape& shape) {
  json out{{"style", palette::of(shape.style).name}};
  std::visit([&](const auto& form) { put(form, out); }, shape.form);
  if (shape.opacity != 1.0) out["opacity"] = rounded(shape.opacity);
  return out;
}

json to_json(const Element& element) {
  json out{{"layer", palette::of(element.layer).name}, {"key", element.key}, {"type", element.type}};
  if (element.id != kNoElement) out["id"] = element.id;
  if (element.status) out["status"] = name(*element.status);
  if (!element.properties.empty()) out["properties"] = element.properties;
  for (const Shape& shape : element.shapes) out["shapes"].push_back(to_json(shape));
  return out;
}

std::string hex(const Colour& colour) {
  std::array<char, 10> text{};
  const auto byte = [](double share) { return static_cast<unsigned>(std::lround(share * 255.0)) & 0xFFU; };
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x%02x", byte(colour.red), byte(colour.green),
                byte(colour.blue), byte(colour.alpha));
  return text.data();
}

json to_json(const palette::StyleSpec& spec) {
  json out{{"light", hex(spec.light)}, {"dark", hex(spec.dark)}};
  if (spec.width > 0.0) out["width"] = spec.width;
  if (spec.dash_on > 0.0) out["dash"] = {spec.dash_on, spec.dash_off};
  if (spec.head > 0.0) out["head"] = spec.head;
  if (spec.text > 0.0) out["text"] = spec.text;
  return out;
}

json theme(const Colour& ground, const Colour& text, const Colour& faint) {
  return {{"ground", hex(ground)}, {"text", hex(text)}, {"faint", hex(faint)}};
}

}  // namespace

json to_json(const Drawing& drawing) {
  const Point forward = drawing.T_map_body.linear() * Point::UnitX();
  json pose = flat({drawing.T_map_body.translation()});
  pose.push_back(rounded(std::atan2(forward.y(), forward.x())));
  json out{
      {"stamp_ns", std::to_string(drawing.stamp_ns)}, {"pose", std::move(pose)}, {"elements", json::array()}};
  for (const Element& element : drawing.elements()) out["elements"].push_back(to_json(element));
  for (const LineageEvent& event : drawing.lineage) out["lineage"].push_back(properties_of(event));
  return out;
}

json palette_json() {
  json out{{"light", theme(palette::kGround, palette::kText, palette::kFaint)},
           {"dark", theme(palette::kDarkGround, palette::kDarkText, palette::kDarkFaint)}};
  for (std::size_t i = 0; i < kLayerCount; ++i) {
    const palette::LayerSpec& layer = palette::of(static_cast<Layer>(i));
    out["layers"].push_back({{"name", layer.name},
                             {"title", layer.title},
                             {"sample", palette::of(layer.sample).name},
                             {"shown", layer.shown},
                             {"overlay", layer.overlay}});
  }
  for (const auto& legend : {palette::legend(), palette::traffic_legend()})
    for (const palette::LegendEntry& entry : legend)
      out["legend"].push_back({{"style", palette::of(entry.style).name}, {"title", entry.title}});
  for (std::size_t i = 0; i < kStyleCount; ++i) {
    const palette::StyleSpec& style = palette::of(static_cast<Style>(i));
    out["styles"][style.name] = to_json(style);
  }
  return out;
}

}  // namespace laneloom::drawing
