#include "simulation/opendrive_line.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

namespace laneloom::simulation {
namespace {

constexpr double kMostNumber = 1e7;
constexpr double kMostLength_m = 100e3;  // of a road
constexpr double kCurveStep_m = 1.0;
constexpr double kSharpest_per_m = 100.0;

}  // namespace

double number_or(const pugi::xml_node& road, const pugi::xml_node& element, const char* name,
                 double otherwise) {
  const pugi::xml_attribute attribute = element.attribute(name);
  if (!attribute) return otherwise;
  const std::string text = attribute.as_string();
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || text.find_first_not_of(" \t\n", used) != std::string::npos ||
      !(std::abs(value) <= kMostNumber))
    refuse(road, std::string("has no number within reach as ") + element.name() + "." + name);
  return value;
}

double number(const pugi::xml_node& road, const pugi::xml_node& element, const char* name) {
  if (!element.attribute(name)) refuse(road, std::string("has no ") + element.name() + "." + name);
  return number_or(road, element, name, 0.0);
}

Cubics::Cubics(const pugi::xml_node& road, const pugi::xml_node& parent, const char* name,
               const char* start) {
  for (const pugi::xml_node& record : parent.children(name))
    cubics_.push_back({number(road, record, start), number(road, record, "a"),
                       number_or(road, record, "b", 0.0), number_or(road, record, "c", 0.0),
                       number_or(road, record, "d", 0.0)});
  std::ranges::stable_sort(cubics_, {}, &Cubic::start_m);
}

double Cubics::at(double place_m) const {
  if (cubics_.empty()) return 0.0;
  const auto next = std::ranges::upper_bound(cubics_, place_m, {}, &Cubic::start_m);
  const Cubic& cubic = next == cubics_.begin() ? *next : *std::prev(next);
  return cubic.at(std::max(0.0, place_m - cubic.start_m));
}

Geometry::Geometry(const pugi::xml_node& road, const pugi::xml_node& element)
    : start_m_(number(road, element, "s")), length_m_(number(road, element, "length")) {
  if (!(length_m_ >= 0.0 && length_m_ <= kMostLength_m)) refuse(road, "has a geometry of such a length");
  start_.position = {number(road, element, "x"), number(road, element, "y"), 0.0};
  start_.heading_rad = number(road, element, "hdg");
  const auto curvature = [&](const pugi::xml_node& curve, const char* name) {
    const double value = number(road, curve, name);
    if (std::abs(value) > kSharpest_per_m) refuse(road, "has a geometry of such a curvature");
    return value;
  };
  const auto cubic = [&](const pugi::xml_node& curve, const char* suffix) {
    const auto part = [&](const char* letter) {
      return number(road, curve, (std::string(letter) + suffix).c_str());
    };
    return Cubic{0.0, part("a"), part("b"), part("c"), part("d")};
  };
  if (const auto arc = element.child("arc")) {
    curvature_ = curvature(arc, "curvature");
  } else if (const auto spiral = element.child("spiral")) {
    kind_ = Kind::spiral;
    curvature_ = curvature(spiral, "curvStart");
    if (length_m_ > 0.0) curvature_rate_ = (curvature(spiral, "curvEnd") - curvature_) / length_m_;
  } else if (const auto poly3 = element.child("poly3")) {
    kind_ = Kind::poly3;
    v_ = cubic(poly3, "");
  } else if (const auto curve = element.child("paramPoly3")) {
    kind_ = Kind::param_poly3;
    u_ = cubic(curve, "U");
    v_ = cubic(curve, "V");
    if (std::string_view(curve.attribute("pRange").as_string()) == "arcLength") end_parameter_ = length_m_;
  } else if (!element.child("line")) {
    refuse(road, "has a geometry that is no line, arc, spiral, poly3 or paramPoly3");
  }
  if (kind_ != Kind::spiral && kind_ != Kind::poly3) return;
  steps_.push_back({});
  for (double at_m = kCurveStep_m; at_m < length_m_; at_m += kCurveStep_m) {
    const Step& last = steps_.back();
    if (kind_ == Kind::spiral) {
      steps_.push_back({at_m, along_spiral(at_m).position.head<2>()});
    } else {
      // The step along u that is a metre along the curve, by the slope in its middle.
      const double half = 0.5 * kCurveStep_m / std::hypot(1.0, v_.slope(last.along));
      steps_.push_back({.along = last.along + kCurveStep_m / std::hypot(1.0, v_.slope(last.along + half))});
    }
  }
}

double Geometry::spiral_heading(double distance_m) const {
  return distance_m * (curvature_ + 0.5 * curvature_rate_ * distance_m);
}

Frame Geometry::along_spiral(double distance_m) const {
  const auto number = std::min(steps_.size() - 1, static_cast<std::size_t>(distance_m / kCurveStep_m));
  const Step& from = steps_[number];
  const auto direction = [&](double at_m) {
    const double heading = spiral_heading(at_m);
    return Eigen::Vector2d(std::cos(heading), std::sin(heading));
  };
  // Simpson's rule.
  const double rest_m = distance_m - from.along;
  const Eigen::Vector2d sum =
      direction(from.along) + 4.0 * direction(from.along + 0.5 * rest_m) + direction(distance_m);
  Frame frame;
  frame.position.head<2>() = from.place + rest_m / 6.0 * sum;
  frame.heading_rad = spiral_heading(distance_m);
  return frame;
}

Frame Geometry::local(double distance_m) const {
  Frame frame;
  if (kind_ == Kind::spiral) return along_spiral(distance_m);
  if (kind_ == Kind::arc) {
    const double turn = curvature_ * distance_m;
    const double chord_m = std::abs(turn) < 1e-9 ? distance_m : std::sin(0.5 * turn) / (0.5 * curvature_);
    frame.position = {chord_m * std::cos(0.5 * turn), chord_m * std::sin(0.5 * turn), 0.0};
    frame.heading_rad = turn;
    return frame;
  }
  double along = 0.0;
  if (kind_ == Kind::poly3) {
    const auto number = std::min(steps_.size() - 1, static_cast<std::size_t>(distance_m / kCurveStep_m));
    const double rest_m = distance_m - static_cast<double>(number) * kCurveStep_m;
    along = steps_[number].along + rest_m / std::hypot(1.0, v_.slope(steps_[number].along));
    frame.position = {along, v_.at(along), 0.0};
    frame.heading_rad = std::atan(v_.slope(along));
    return frame;
  }
  if (length_m_ > 0.0) along = distance_m / length_m_ * end_parameter_;
  frame.position = {u_.at(along), v_.at(along), 0.0};
  frame.heading_rad = std::atan2(v_.slope(along), u_.slope(along));
  return frame;
}

Frame Geometry::at(double distance_m) const {
  const Frame here = local(std::clamp(distance_m, 0.0, length_m_));
  Frame frame = start_.moved(here.position.y(), here.position.x());
  frame.heading_rad = start_.heading_rad + here.heading_rad;
  return frame;
}

ReferenceLine::ReferenceLine(const pugi::xml_node& road)
    : elevation_(road, road.child("elevationProfile"), "elevation", "s") {
  double sum_m = 0.0;
  for (const pugi::xml_node& element : road.child("planView").children("geometry")) {
    geometries_.emplace_back(road, element);
    sum_m += geometries_.back().length_m();
    if (sum_m > kMostLength_m) refuse(road, "is beyond 100 km");
  }
  if (geometries_.empty()) refuse(road, "has no geometry");
  std::ranges::stable_sort(geometries_, {}, &Geometry::start_m);
  length_m_ = geometries_.back().start_m() + geometries_.back().length_m();
  if (!(length_m_ <= kMostLength_m)) refuse(road, "is beyond 100 km");
}

Frame ReferenceLine::at(double s_m) const {
  const auto next = std::ranges::upper_bound(geometries_, s_m, {}, &Geometry::start_m);
  const Geometry& geometry = next == geometries_.begin() ? *next : *std::prev(next);
  Frame frame = geometry.at(s_m - geometry.start_m());
  frame.position.z() = elevation_.at(s_m);
  return frame;
}

Point ReferenceLine::point(double s_m, double left_m) const { return at(s_m).moved(left_m).position; }

}  // namespace laneloom::simulation
