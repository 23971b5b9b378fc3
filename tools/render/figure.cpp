#include "render/figure.hpp"

#include <algorithm>

#include "drawing/palette.hpp"
#include "render/panel.hpp"

namespace laneloom::render {
namespace {

constexpr double kMargin = 18.0;
constexpr double kGap = 14.0;
constexpr double kTitleHeight = 34.0;
constexpr double kPanelTitleHeight = 22.0;

void draw_scale(Canvas& canvas, const Pixel& bottom_left) {
  constexpr double kLength_m = 10.0;
  const Pixel from = bottom_left + Pixel(10.0, -10.0),
              to = from + Pixel(kLength_m * PanelView::kPixelsPerMetre, 0.0);
  const Pixel tick(0.0, 4.0);
  canvas.stroke({from - tick, from, to, to - tick}, {drawing::palette::kText, 1.4, {}});
  canvas.text((from + to) / 2 - Pixel(0.0, 5.0), "10 m", 11.0, drawing::palette::kText, Align::centre);
}

void draw_moment(Canvas& canvas, const Moment& moment, const RangeConfig& range, const Pixel& top_left) {
  const Pixel size = PanelView::size_of(range);
  Pixel at = top_left;
  for (const Panel& panel : moment.panels) {
    const PanelView view(range, moment.T_map_body, at + Pixel(0.0, kPanelTitleHeight));
    canvas.text(at + Pixel(1.0, 15.0), panel.title, 13.0, drawing::palette::kText, Align::left, true);
    canvas.text(at + Pixel(size.x() - 1.0, 15.0), moment.label, 12.0, drawing::palette::kFaint, Align::right);
    draw_panel(canvas, view, panel.drawing);
    draw_scale(canvas, view.top_left() + Pixel(0.0, size.y()));
    at.x() += size.x() + kGap;
  }
}

/// The measures of a figure, in pixels.
struct Layout {
  explicit Layout(const Figure& figure) {
    const Pixel panel = PanelView::size_of(figure.range);
    std::size_t columns = 1;
    for (const Moment& moment : figure.moments) columns = std::max(columns, moment.panels.size());
    row_height = kPanelTitleHeight + panel.y() + kGap;
    width = 2 * kMargin + static_cast<double>(columns) * (panel.x() + kGap) - kGap;
    height = 2 * kMargin + kTitleHeight + static_cast<double>(figure.moments.size()) * row_height +
             legend_height(inner_width());
  }
  double inner_width() const { return width - 2 * kMargin; }

  double row_height, width, height;
};

void draw(const Figure& figure, const Layout& layout, Canvas& canvas) {
  canvas.text({kMargin, kMargin + 14.0}, figure.title, 17.0, drawing::palette::kText, Align::left, true);
  Pixel at(kMargin, kMargin + kTitleHeight);
  for (const Moment& moment : figure.moments) {
    draw_moment(canvas, moment, figure.range, at);
    at.y() += layout.row_height;
  }
  draw_legend(canvas, at, layout.inner_width());
  canvas.finish();
}

Canvas drawn_in_memory(const Figure& figure, bool svg) {
  const Layout layout(figure);
  Canvas canvas = Canvas::in_memory(svg, layout.width, layout.height);
  draw(figure, layout, canvas);
  return canvas;
}

}  // namespace

void draw_figure(const Figure& figure, const std::string& path) {
  const Layout layout(figure);
  Canvas canvas(path, layout.width, layout.height);
  draw(figure, layout, canvas);
}

Image draw_image(const Figure& figure) { return drawn_in_memory(figure, false).image(); }

std::string draw_svg(const Figure& figure) { return drawn_in_memory(figure, true).svg(); }

}  // namespace laneloom::render
