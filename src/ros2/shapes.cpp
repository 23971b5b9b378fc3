#include "ros2/shapes.hpp"

#include <algorithm>

#include "ros2/parts.hpp"

namespace laneloom::ros2 {
namespace {

constexpr Color kSolid{1.0F, 1.0F, 1.0F, 1.0F};
constexpr Color kDashed{0.35F, 0.75F, 1.0F, 1.0F};
constexpr Color kUnknown{0.65F, 0.65F, 0.65F, 1.0F};
constexpr Color kEdge{0.95F, 0.55F, 0.2F, 1.0F};

std_msgs::msg::dds_::ColorRGBA_ to_color(const Color& from) {
  std_msgs::msg::dds_::ColorRGBA_ to;
  to.r(from.r);
  to.g(from.g);
  to.b(from.b);
  to.a(from.a);
  return to;
}

void set_scale(double x, double y, double z, Marker& marker) {
  marker.scale().x(x);
  marker.scale().y(y);
  marker.scale().z(z);
}

Color color_of(const Marking& marking, double arc_m) {
  if (marking.type == MarkingType::roadedge) return kEdge;
  const auto style = std::ranges::find_if(
      marking.styles, [&](const StyleRange& s) { return arc_m >= s.range.from_m && arc_m <= s.range.to_m; });
  if (style == marking.styles.end() || style->style == MarkingStyle::unknown) return kUnknown;
  return style->style == MarkingStyle::solid ? kSolid : kDashed;
}

float opacity(ElementStatus status) { return status == ElementStatus::confirmed ? 1.0F : 0.4F; }

/// Arc length at each point, as shares of the whole.
std::vector<double> shares(const Polyline& line) {
  std::vector<double> arcs{0.0};
  for (std::size_t i = 1; i < line.size(); ++i) arcs.push_back(arcs.back() + (line[i] - line[i - 1]).norm());
  const double length_m = std::max(arcs.back(), 1e-9);
  for (double& arc : arcs) arc /= length_m;
  return arcs;
}

}  // namespace

void make_line(const Polyline& points, double width_m, const Color& color, Marker& marker) {
  marker.type(kLineStrip);
  set_scale(width_m, 0.0, 0.0, marker);
  marker.color(to_color(color));
  for (const Point& point : points) marker.points().push_back(to_point(point));
}

void make_styled_line(const Marking& marking, double width_m, Marker& marker) {
  make_line(marking.points, width_m, kUnknown, marker);
  double arc_m = 0.0;
  for (std::size_t i = 0; i < marking.points.size(); ++i) {
    if (i > 0) arc_m += (marking.points[i] - marking.points[i - 1]).norm();
    Color color = color_of(marking, arc_m);
    color.a = opacity(marking.status);
    marker.colors().push_back(to_color(color));
  }
}

void make_area(const Polyline& left, const Polyline& right, const Color& color, Marker& marker) {
  marker.type(kTriangleList);
  set_scale(1.0, 1.0, 1.0, marker);
  marker.color(to_color(color));
  const auto left_shares = shares(left), right_shares = shares(right);
  std::size_t l = 0, r = 0;
  while (l + 1 < left.size() || r + 1 < right.size()) {
    const bool on_left =
        r + 1 == right.size() || (l + 1 < left.size() && left_shares[l + 1] <= right_shares[r + 1]);
    const Point& next = on_left ? left[l + 1] : right[r + 1];
    for (const Point& corner : {left[l], right[r], next}) marker.points().push_back(to_point(corner));
    ++(on_left ? l : r);
  }
}

void make_text(const Point& at, const std::string& text, double height_m, const Color& color,
               Marker& marker) {
  marker.type(kTextViewFacing);
  set_scale(0.0, 0.0, height_m, marker);
  marker.color(to_color(color));
  marker.pose().position(to_point(at));
  marker.text(text);
}

}  // namespace laneloom::ros2
