#include "drawing/marking_shapes.hpp"

#include "laneloom/polyline.hpp"

namespace laneloom::drawing {
namespace {

constexpr double kMinLength_m = 0.01;

}  // namespace

bool drawable(const Polyline& line) { return line.size() >= 2 && length(line) > kMinLength_m; }

std::vector<Shape> marking_shapes(const Marking& marking, double opacity) {
  if (!drawable(marking.points)) return {};
  std::vector<Shape> shapes;
  const auto add = [&](Polyline stretch, MarkingStyle style) {
    shapes.push_back({DrawnLine{std::move(stretch)}, palette::marking_style(marking.type, style), opacity});
  };
  if (marking.styles.empty()) add(marking.points, MarkingStyle::unknown);
  const MeasuredPolyline line(marking.points);
  for (const StyleRange& style : marking.styles)
    if (Polyline stretch = line.slice(style.range); stretch.size() >= 2) add(std::move(stretch), style.style);
  return shapes;
}

std::vector<Shape> arrow_along(const Polyline& line, Style style, double opacity) {
  const Point along = (line.back() - line[line.size() - 2]).normalized();
  return {{DrawnLine{line}, style, opacity}, {DrawnArrow{line.back(), along}, style, opacity}};
}

double opacity_of(double existence_probability) {
  return existence_probability < 0.0 ? 1.0 : 0.3 + 0.7 * existence_probability;
}

std::string key_of(Layer layer, ElementId id) {
  return std::string(palette::of(layer).name) + "/" + std::to_string(id);
}

}  // namespace laneloom::drawing
