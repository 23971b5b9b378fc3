#pragma once

#include "VisualizationMsgs.hpp"
#include "laneloom/types.hpp"

/// Shapes and colours of markers.
namespace laneloom::ros2 {

using Marker = visualization_msgs::msg::dds_::Marker_;

/// Types and actions, as visualization_msgs/Marker numbers them.
enum MarkerType : std::int32_t { kLineStrip = 4, kTextViewFacing = 9, kTriangleList = 11 };
enum MarkerAction : std::int32_t { kAdd = 0, kDelete = 2 };

/// Red, green, blue and opacity, 0..1.
struct Color {
  float r = 0, g = 0, b = 0, a = 1;
};

/// A line of `width_m`. The line has two points or more.
void make_line(const Polyline& points, double width_m, const Color& color, Marker& marker);
/// A line whose parts are in the colours of their styles.
void make_styled_line(const Marking& marking, double width_m, Marker& marker);
/// The area between two lines that run in the same direction.
void make_area(const Polyline& left, const Polyline& right, const Color& color, Marker& marker);
/// A text of `height_m` that faces the viewer.
void make_text(const Point& at, const std::string& text, double height_m, const Color& color, Marker& marker);

}  // namespace laneloom::ros2
