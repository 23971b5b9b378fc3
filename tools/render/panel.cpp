#include "render/panel.hpp"

#include <cmath>

#include "mapping/geometry/left_of.hpp"

namespace laneloom::render {
namespace {

constexpr double kAroundBox_m = 2.0;
constexpr double kArrowStep_m = 0.3;  ///< tells an arrow's direction on the canvas
constexpr double kLegendColumn = 145.0;
constexpr double kLegendLine = 18.0;

/// An arrow head with its tip at `tip`.
Outline arrow_head(const Pixel& tip, const Pixel& direction, double size) {
  const Pixel along = direction.normalized() * size, across = geometry::left_of(along);
  return {tip, tip - along + 0.45 * across, tip - 0.7 * along, tip - along - 0.45 * across, tip};
}

Pen pen_of(drawing::Style style, double opacity) {
  const drawing::palette::StyleSpec& spec = drawing::palette::of(style);
  Pen pen{spec.light.faded(opacity), spec.width, {}};
  if (spec.dash_on > 0.0) pen.dashes = {spec.dash_on, spec.dash_off};
  return pen;
}

/// Draws shapes as they lie in a view.
class Painter {
 public:
  Painter(Canvas& canvas, const PanelView& view) : canvas_(canvas), view_(view) {}

  void draw(const drawing::Shape& shape) {
    std::visit([&](const auto& form) { draw(form, shape); }, shape.form);
  }

 private:
  static drawing::Colour colour_of(const drawing::Shape& shape) {
    return drawing::palette::of(shape.style).light.faded(shape.opacity);
  }

  void draw(const drawing::DrawnLine& line, const drawing::Shape& shape) {
    canvas_.stroke(view_.map(line.points), pen_of(shape.style, shape.opacity));
  }
  void draw(const drawing::DrawnArea& area, const drawing::Shape& shape) {
    Polyline outline = area.left;
    outline.insert(outline.end(), area.right.rbegin(), area.right.rend());
    canvas_.fill(view_.map(outline), colour_of(shape));
  }
  void draw(const drawing::DrawnArrow& arrow, const drawing::Shape& shape) {
    const Pixel tip = view_.map(arrow.tip);
    const Pixel before = view_.map(Point(arrow.tip - kArrowStep_m * arrow.direction));
    canvas_.fill(arrow_head(tip, tip - before, drawing::palette::of(shape.style).head), colour_of(shape));
  }
  void draw(const drawing::DrawnText& text, const drawing::Shape& shape) {
    canvas_.text(view_.map(text.position), text.text, drawing::palette::of(shape.style).text,
                 colour_of(shape), Align::centre);
  }

  Canvas& canvas_;
  const PanelView& view_;
};

}  // namespace

PanelView::PanelView(const RangeConfig& range, const Eigen::Isometry3d& T_map_body, const Pixel& top_left)
    : origin_(top_left +
              kPixelsPerMetre * Pixel(range.side_max_m + kAroundBox_m, range.forward_max_m + kAroundBox_m)),
      top_left_(top_left),
      size_(size_of(range)),
      T_body_map_(T_map_body.inverse()) {}

Pixel PanelView::size_of(const RangeConfig& range) {
  return kPixelsPerMetre * Pixel(2.0 * range.side_max_m + 2.0 * kAroundBox_m,
                                 range.forward_max_m - range.forward_min_m + 2.0 * kAroundBox_m);
}

Pixel PanelView::map(const Point& point) const {
  const Point in_body = T_body_map_ * point;
  return origin_ - kPixelsPerMetre * Pixel(in_body.y(), in_body.x());
}

Outline PanelView::map(const Polyline& line) const {
  Outline pixels;
  pixels.reserve(line.size());
  for (const Point& point : line) pixels.push_back(map(point));
  return pixels;
}

void draw_panel(Canvas& canvas, const PanelView& view, const drawing::Drawing& drawing) {
  const Outline frame = rectangle(view.top_left(), view.size());
  canvas.clip(view.top_left(), view.size());
  canvas.fill(frame, drawing::palette::kGround);
  Painter painter(canvas, view);
  for (const drawing::Element& element : drawing.elements())
    for (const drawing::Shape& shape : element.shapes) painter.draw(shape);
  canvas.unclip();
  canvas.stroke(frame, {drawing::palette::kBox.faded(0.6), 0.8, {}});
}

double legend_height(double width) {
  const double columns = std::max(1.0, std::floor(width / kLegendColumn));
  return kLegendLine * std::ceil(static_cast<double>(drawing::palette::legend().size()) / columns);
}

void draw_legend(Canvas& canvas, const Pixel& top_left, double width) {
  constexpr double kSample = 26.0;
  Pixel at = top_left + Pixel(0.0, kLegendLine / 2);
  for (const auto& [style, title] : drawing::palette::legend()) {
    const drawing::palette::StyleSpec& spec = drawing::palette::of(style);
    if (spec.head > 0.0) canvas.fill(arrow_head(at + Pixel(kSample, 0), {1, 0}, spec.head), spec.light);
    if (spec.width > 0.0)
      canvas.stroke({at, at + Pixel(kSample, 0)}, pen_of(style, 1.0));
    else
      canvas.fill(rectangle(at - Pixel(0, 5), {kSample, 10}), spec.light);
    canvas.text(at + Pixel(kSample + 6.0, 4.0), title, 11.0, drawing::palette::kText);
    at.x() += kLegendColumn;
    if (at.x() + kLegendColumn > top_left.x() + width) at = Pixel(top_left.x(), at.y() + kLegendLine);
  }
}

}  // namespace laneloom::render
