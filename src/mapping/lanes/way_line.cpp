#include "mapping/lanes/way_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/geometry/smooth_step.hpp"
#include "mapping/lanes/smooth_line.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kNoStep_m = 0.05;  // of noise
constexpr double kMaxSlope = 1.0 / 40.0;
constexpr double kMaxTransition_m = 15.0;  // to either side of a joint
constexpr double kMinWeight = 0.01;
constexpr double kStraight_per_m = 0.01, kBend_per_m = 0.04;
constexpr double kBendWeight = 30.0;
constexpr double kTightest_per_m = 0.4;  // cars turn on 5 m or more, and their lanes are hardly tighter
constexpr std::size_t kNear = 4;         // samples that know of a bend before it begins

/// In a bend noise is less than what smoothing cuts: there the line keeps nearer to the route.
double weight_of_bend(double curvature_per_m) {
  return 1.0 + kBendWeight * geometry::smooth_step((curvature_per_m - kStraight_per_m) / kBend_per_m);
}

/// How much a place of the route counts: the line passes over a step with a slope that is no steeper than
/// `kMaxSlope`, about.
double weight_at(double along_m, const std::vector<RouteJoint>& joints) {
  double weight = 1.0;
  for (const RouteJoint& joint : joints) {
    if (joint.step_m < kNoStep_m) continue;
    const double reach_m = std::min(kMaxTransition_m, joint.step_m / kMaxSlope);
    weight = std::min(weight, geometry::smooth_step(std::abs(along_m - joint.along_m) / reach_m));
  }
  return std::max(kMinWeight, weight);
}

}  // namespace

std::vector<RoutePlace> sampled(const Route& route) {
  std::vector<RoutePlace> places;
  const std::vector<RoutePoint>& points = route.points;
  places.reserve(static_cast<std::size_t>(points.back().along_m / kSample_m) + 1);
  std::size_t i = 0;
  for (double along_m = 0.0; along_m <= points.back().along_m; along_m += kSample_m) {
    while (i + 2 < points.size() && points[i + 1].along_m <= along_m) ++i;
    const RoutePoint &a = points[i], &b = points[std::min(i + 1, points.size() - 1)];
    const double share = (along_m - a.along_m) / std::max(1e-9, b.along_m - a.along_m);
    const bool within = a.piece == b.piece;
    places.push_back({.point = a.point + share * (b.point - a.point),
                      .piece = b.piece,
                      .arc_m = within ? a.arc_m + share * (b.arc_m - a.arc_m) : b.arc_m,
                      .weight = weight_at(along_m, route.joints)});
  }
  return places;
}

WayLine::WayLine(std::vector<RoutePlace> places) : places_(std::move(places)) {
  Polyline points;
  std::vector<double> weights;
  weights.reserve(places_.size());
  points.reserve(places_.size());
  for (const RoutePlace& place : places_) {
    points.push_back(place.point);
    weights.push_back(place.weight);
  }
  points_ = smooth_line(points, weights);
  measure();
  const auto bends = [](double curvature_per_m) { return std::abs(curvature_per_m) > kStraight_per_m; };
  if (std::ranges::any_of(curvatures_per_m_, bends)) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= weight_of_bend(sharpest_near(i));
    points_ = smooth_line(points, weights);
    measure();
  }
  arcs_m_ = arc_lengths(points_);
}

double WayLine::sharpest_near(std::size_t i) const {
  double sharpest_per_m = 0.0;
  const std::size_t last = std::min(i + kNear, curvatures_per_m_.size() - 1);
  for (std::size_t k = i - std::min(i, kNear); k <= last; ++k)
    sharpest_per_m = std::max(sharpest_per_m, std::abs(curvatures_per_m_[k]));
  return sharpest_per_m;
}

void WayLine::measure() {
  const std::size_t last = points_.size() - 1;
  directions_.assign(points_.size(), (points_[last] - points_[0]).head<2>().normalized());
  curvatures_per_m_.assign(points_.size(), 0.0);
  if (last < 2) return;
  for (std::size_t i = 1; i < last; ++i) {
    const Eigen::Vector2d in = (points_[i] - points_[i - 1]).head<2>(),
                          out = (points_[i + 1] - points_[i]).head<2>();
    directions_[i] = (in + out).normalized();
    // Of the circle through the three points.
    curvatures_per_m_[i] = 2.0 * cross(in, out) / (in.norm() * out.norm() * (in + out).norm());
  }
  // On an arc, a chord has the mean direction of its ends.
  const auto beyond = [this](std::size_t inner, std::size_t from, std::size_t to) {
    const Eigen::Vector2d chord = (points_[to] - points_[from]).head<2>().normalized();
    return Eigen::Vector2d((2.0 * chord.dot(directions_[inner]) * chord - directions_[inner]).normalized());
  };
  directions_.front() = beyond(1, 0, 1);
  directions_.back() = beyond(last - 1, last - 1, last);
  curvatures_per_m_.front() = curvatures_per_m_[1];
  curvatures_per_m_.back() = curvatures_per_m_[last - 1];
}

WayLine::Between WayLine::find(double arc_m) const {
  const auto after = std::upper_bound(arcs_m_.begin() + 1, arcs_m_.end() - 1, arc_m);
  const auto i = static_cast<std::size_t>(after - arcs_m_.begin()) - 1;
  return {i, std::clamp((arc_m - arcs_m_[i]) / (arcs_m_[i + 1] - arcs_m_[i]), 0.0, 1.0)};
}

double WayLine::drivable_to(double from_m) const {
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (arcs_m_[i] > from_m && std::abs(curvatures_per_m_[i]) > kTightest_per_m) return arcs_m_[i];
  return length();
}

double WayLine::foot(const Point& point) const {
  const auto distance_m2 = [&](const Point& other) { return (other - point).head<2>().squaredNorm(); };
  const auto nearest = std::ranges::min_element(points_, {}, distance_m2);
  const auto i = static_cast<std::size_t>(nearest - points_.begin());
  return arcs_m_[i] + directions_[i].dot((point - *nearest).head<2>());
}

WayLine::Sample WayLine::at(double arc_m) const {
  const auto [i, t] = find(arc_m);
  const double step_m = arcs_m_[i + 1] - arcs_m_[i];
  const RoutePlace& nearest = places_[t < 0.5 ? i : i + 1];
  Sample sample;
  sample.place = nearest;
  if (places_[i].piece == places_[i + 1].piece)
    sample.place.arc_m = places_[i].arc_m + t * (places_[i + 1].arc_m - places_[i].arc_m);
  sample.point = points_[i] + t * (points_[i + 1] - points_[i]);
  // A cubic in Hermite's basis, seen from above.
  sample.point.head<2>() = (points_[i] + geometry::smooth_step(t) * (points_[i + 1] - points_[i])).head<2>() +
                           t * (1.0 - t) * step_m * ((1.0 - t) * directions_[i] - t * directions_[i + 1]);
  sample.direction = ((1.0 - t) * directions_[i] + t * directions_[i + 1]).normalized();
  sample.curvature_per_m = (1.0 - t) * curvatures_per_m_[i] + t * curvatures_per_m_[i + 1];
  return sample;
}

}  // namespace laneloom::lanes
