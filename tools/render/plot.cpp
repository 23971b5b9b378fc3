#include "render/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "drawing/palette.hpp"
#include "render/canvas.hpp"

namespace laneloom::render {
namespace {

constexpr double kWidth = 760.0;
constexpr double kPlotHeight = 150.0;  // of the area with the curves
constexpr double kLeft = 52.0;
constexpr double kRight = 18.0;
constexpr double kAbove = 40.0;  // title and legend
constexpr double kBelow = 40.0;  // ticks and label
constexpr double kPlotMargin = 8.0;
constexpr double kTickText = 11.0;
constexpr double kCurveWidth = 1.4;
constexpr int kYTicks = 5;
constexpr int kXTicks = 10;
const Pen kGrid{{0.88, 0.88, 0.90}, 0.8, {}};

struct Interval {
  double from = 0.0;
  double to = 0.0;
  double span() const { return to - from; }
};

double half_bin(const Plot& plot) {
  if (!plot.binned) return 0.0;
  for (const Curve& curve : plot.curves)
    if (curve.points.size() > 1) return 0.5 * (curve.points[1].x() - curve.points[0].x());
  return 0.5;
}

Interval x_interval(const Plot& plot) {
  Interval x{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Curve& curve : plot.curves) {
    for (const Eigen::Vector2d& point : curve.points) {
      x.from = std::min(x.from, point.x());
      x.to = std::max(x.to, point.x());
    }
  }
  if (!(x.from <= x.to)) return {0.0, 1.0};
  const double around = x.span() > 0.0 ? half_bin(plot) : 0.5;
  return {x.from - around, x.to + around};
}

Interval y_interval(const Plot& plot) {
  if (plot.y_max) return {0.0, *plot.y_max};
  double highest = 0.0;
  for (const Curve& curve : plot.curves)
    for (const Eigen::Vector2d& point : curve.points)
      if (point.y() > highest) highest = point.y();  // false for NaN
  if (highest == 0.0) return {0.0, 1.0};
  const double step = tick_step(highest, kYTicks);
  return {0.0, std::ceil(highest / step) * step};
}

/// Takes a plot's values to places on the canvas.
class Axes {
 public:
  Axes(const Plot& plot, const Pixel& sheet_top_left)
      : x_(x_interval(plot)),
        y_(y_interval(plot)),
        top_left_(sheet_top_left + Pixel(kLeft, kAbove)),
        size_(kWidth - kLeft - kRight, kPlotHeight) {}

  Pixel at(double x, double y) const {
    return top_left_ + Pixel((x - x_.from) / x_.span() * size_.x(), (y_.to - y) / y_.span() * size_.y());
  }
  const Interval& x() const { return x_; }
  const Interval& y() const { return y_; }
  const Pixel& top_left() const { return top_left_; }
  const Pixel& size() const { return size_; }

 private:
  Interval x_, y_;
  Pixel top_left_, size_;
};

std::string tick_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", std::abs(value) < 1e-9 ? 0.0 : value);
  return text.data();
}

/// Multiples of the tick step within an axis.
std::vector<double> ticks(const Interval& axis, int count) {
  const double step = tick_step(axis.span(), count);
  std::vector<double> ticks;
  for (double n = std::ceil(axis.from / step - 1e-6); n * step <= axis.to + 1e-6 * step; ++n)
    ticks.push_back(n * step);
  return ticks;
}

void draw_axes(Canvas& canvas, const Axes& axes, const Plot& plot) {
  for (const double y : ticks(axes.y(), kYTicks)) {
    canvas.stroke({axes.at(axes.x().from, y), axes.at(axes.x().to, y)}, kGrid);
    canvas.text(axes.at(axes.x().from, y) + Pixel(-6.0, 4.0), tick_text(y), kTickText,
                drawing::palette::kText, Align::right);
  }
  for (const double x : ticks(axes.x(), kXTicks)) {
    canvas.stroke({axes.at(x, axes.y().from), axes.at(x, axes.y().to)}, kGrid);
    canvas.text(axes.at(x, axes.y().from) + Pixel(0.0, 15.0), tick_text(x), kTickText,
                drawing::palette::kText, Align::centre);
  }
  canvas.stroke(rectangle(axes.top_left(), axes.size()), {drawing::palette::kBox, 1.0, {}});
  canvas.text(axes.top_left() + Pixel(axes.size().x() / 2, axes.size().y() + 31.0), plot.x_label, kTickText,
              drawing::palette::kFaint, Align::centre);
}

Pen pen_of(const Curve& curve) { return {curve.colour, kCurveWidth, {}}; }

void draw_marker(Canvas& canvas, const Pixel& at, const drawing::Colour& colour) {
  const Pixel half(2.5, 2.5);
  canvas.fill(rectangle(at - half, 2 * half), colour);
}

void draw_curve(Canvas& canvas, const Axes& axes, const Curve& curve, bool marked) {
  Outline stretch;
  const auto finish_stretch = [&] {
    if (stretch.size() > 1) canvas.stroke(stretch, pen_of(curve));
    // A single point could not be seen as a line.
    if (marked || stretch.size() == 1)
      for (const Pixel& pixel : stretch) draw_marker(canvas, pixel, curve.colour);
    stretch.clear();
  };
  for (const Eigen::Vector2d& point : curve.points) {
    if (std::isnan(point.y())) {
      finish_stretch();
    } else {
      stretch.push_back(axes.at(point.x(), point.y()));
    }
  }
  finish_stretch();
}

/// Draws the legend in one line, which ends at `right_end`.
void draw_legend(Canvas& canvas, const std::vector<Curve>& curves, const Pixel& right_end) {
  constexpr double kSwatch = 26.0, kSpace = 5.0, kLetter = 7.0, kLegendGap = 16.0;
  const auto width = [](const Curve& curve) {
    return kSwatch + kSpace + kLetter * static_cast<double>(curve.name.size());
  };
  Pixel at = right_end;
  for (const Curve& curve : curves) at.x() -= width(curve) + kLegendGap;
  for (const Curve& curve : curves) {
    at.x() += kLegendGap;
    canvas.stroke({at - Pixel(0.0, 4.0), at + Pixel(kSwatch, -4.0)}, pen_of(curve));
    canvas.text(at + Pixel(kSwatch + kSpace, 0.0), curve.name, kTickText, drawing::palette::kText);
    at.x() += width(curve);
  }
}

void draw_plot(Canvas& canvas, const Plot& plot, const Pixel& top_left) {
  const Axes axes(plot, top_left);
  const double baseline = axes.top_left().y() - 10.0;
  canvas.text({axes.top_left().x(), baseline}, plot.title, 13.0, drawing::palette::kText, Align::left, true);
  draw_legend(canvas, plot.curves, {axes.top_left().x() + axes.size().x(), baseline});
  draw_axes(canvas, axes, plot);
  canvas.clip(axes.top_left() - Pixel(4.0, 4.0), axes.size() + Pixel(8.0, 8.0));
  for (const Curve& curve : plot.curves) draw_curve(canvas, axes, curve, plot.binned);
  canvas.unclip();
}

}  // namespace

double tick_step(double span, int ticks) {
  if (!(span > 0.0 && std::isfinite(span))) return 1.0;
  const double rough = span / ticks;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= rough * 0.999) return step * power;
  return 10.0 * power;
}

void draw_plots(const std::vector<Plot>& plots, const std::string& path) {
  constexpr double kHeight = kAbove + kPlotHeight + kBelow;
  Canvas canvas(path, kWidth, 2 * kPlotMargin + static_cast<double>(plots.size()) * kHeight);
  for (std::size_t i = 0; i < plots.size(); ++i)
    draw_plot(canvas, plots[i], {0.0, kPlotMargin + static_cast<double>(i) * kHeight});
  canvas.finish();
}

}  // namespace laneloom::render
