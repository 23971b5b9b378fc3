#include "mapping/topology/street_ahead.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "laneloom/polyline.hpp"
#include "laneloom/way.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/reproducible.hpp"

namespace laneloom::topology {
namespace {

constexpr double kFitted_m = 30.0;  // of the line that the street is laid onto
constexpr double kLeastFitted_m = 15.0;
constexpr double kSample_m = 1.0;
constexpr double kRounded_m = 5.0;      // to either side of a corner of a street, which is a bend
constexpr double kMost_m = 30.0;        // that a way goes on
constexpr double kLeast_m = 5.0;        // likewise; less is not worth it
constexpr double kMostStddev_m = 1.75;  // half a lane
constexpr int kFitRounds = 5;
constexpr double kStddev_m = 0.5;       // lateral, of the street's line
constexpr double kCorrelated_m = 10.0;  // so many metres of it err alike
constexpr double kMostMisfit_m = 1.0;   // root mean square; another street fits worse
// Standard deviations of the street's place: ahead, to the left, and its heading in rad. Its place to the
// left tells next to nothing, because lanes lie beside the middle.
const Eigen::Vector3d kExpected{3.0, 10.0, 0.3};

/// A rotation about a place, and a shift.
struct Motion {
  Eigen::Vector2d centre;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Vector2d turn = Eigen::Vector2d::UnitX();  ///< where the x axis is turned to

  Eigen::Vector2d turned(const Eigen::Vector2d& direction) const {
    return direction.x() * turn + direction.y() * geometry::left_of(turn);
  }
  Eigen::Vector2d turned_back(const Eigen::Vector2d& direction) const {
    return {turn.dot(direction), geometry::left_of(turn).dot(direction)};
  }
  Eigen::Vector2d moved(const Eigen::Vector2d& place) const {
    return centre + shift + turned(place - centre);
  }
};

/// The motion that lays a line onto the streets.
struct Fit {
  Motion motion;
  double ahead_stddev_m = 0.0;  ///< of the place along the street
  double heading_stddev = 0.0;  ///< in rad
};

/// Sums of one round of least squares, over ahead, left and the turn in rad.
struct Sums {
  Eigen::Matrix3d information = kExpected.array().square().inverse().matrix().asDiagonal();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double misfit_m2 = 0.0;
  int found = 0;
};

Sums sums_of(const SdMap& sd_map, const MeasuredPolyline& line, const Motion& motion) {
  Sums sums;
  const Eigen::Vector2d ahead = motion.turned(line.direction(line.length()));
  for (double arc_m = line.length(); arc_m >= 0.0; arc_m -= kSample_m) {
    const Eigen::Vector2d place = motion.moved(line.at(arc_m).head<2>());
    const auto street = sd_map.beside(place, motion.turned(line.chord(arc_m - kSample_m, arc_m + kSample_m)));
    if (!street) continue;
    const Eigen::Vector2d normal = geometry::left_of(street->direction);
    const Eigen::Vector2d arm = place - motion.centre - motion.shift;
    const Eigen::Vector3d row(normal.dot(ahead), normal.dot(geometry::left_of(ahead)),
                              normal.dot(geometry::left_of(arm)));
    const double misfit_m = normal.dot(place - street->point);
    constexpr double kWeight = kSample_m / (kCorrelated_m * kStddev_m * kStddev_m);
    sums.information += kWeight * row * row.transpose();
    sums.gradient += kWeight * misfit_m * row;
    sums.misfit_m2 += misfit_m * misfit_m;
    ++sums.found;
  }
  return sums;
}

/// Gauss-Newton. Empty: no street lies along the line.
std::optional<Fit> fitted(const SdMap& sd_map, const MeasuredPolyline& line) {
  const Eigen::Matrix3d expected = kExpected.array().square().inverse().matrix().asDiagonal();
  const Eigen::Vector2d ahead = line.direction(line.length());
  Fit fit{.motion{.centre = line.points().back().head<2>()}};
  Motion& motion = fit.motion;
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance;
  for (int round = 0; round < kFitRounds; ++round) {
    const Sums sums = sums_of(sd_map, line, motion);
    if (kSample_m * sums.found < kLeastFitted_m) return std::nullopt;
    if (round + 1 == kFitRounds && sums.misfit_m2 > sums.found * kMostMisfit_m * kMostMisfit_m)
      return std::nullopt;
    covariance = sums.information.inverse();
    const Eigen::Vector3d step = -covariance * (sums.gradient + expected * all);
    all += step;
    motion.shift += step.x() * motion.turned(ahead) + step.y() * geometry::left_of(motion.turned(ahead));
    motion.turn = motion.turned(Eigen::Vector2d(1.0, step.z()).normalized());
  }
  fit.ahead_stddev_m = std::sqrt(covariance(0, 0));
  fit.heading_stddev = std::sqrt(covariance(2, 2));
  return fit;
}

/// The end of the way, with what was driven before it, as long as the street is laid onto it. Empty: it is
/// too short.
Polyline end_of(const Polyline& driven, const Way& way) {
  const WayStation& begin = way.stations.front();
  const Eigen::Vector2d ahead = begin.direction();
  Polyline line = driven;
  while (!line.empty() && ahead.dot((line.back() - begin.point).head<2>()) > -kSample_m) line.pop_back();
  for (const WayStation& station : way.stations) line.push_back(station.point);
  const MeasuredPolyline measured(line);
  if (measured.length() < kLeastFitted_m) return {};
  return measured.slice({measured.length() - kFitted_m, measured.length()});
}

/// The street beyond the end of a line that is driven: its shape, which begins there.
struct StreetAhead {
  Polyline points;            ///< map frame; empty: the map does not know the street
  double stddev_per_m = 0.0;  ///< by which the lateral deviation grows
};

/// The street beyond the end of the line that it was laid onto, in the map frame of the SD map. Its corners
/// are rounded by means over some metres. Empty: it ends there.
Polyline rounded_beyond(const SdMap& sd_map, const MeasuredPolyline& line, const Motion& motion) {
  const double from_m = line.length() - kRounded_m;
  const Eigen::Vector2d direction = motion.turned(line.chord(from_m - kSample_m, from_m + kSample_m));
  const Polyline onward =
      sd_map.onward(motion.moved(line.at(from_m).head<2>()), direction, kMost_m + 3.0 * kRounded_m);
  Polyline rounded;
  if (onward.empty()) return rounded;
  const MeasuredPolyline street(onward);
  const Eigen::Vector2d end = motion.moved(line.points().back().head<2>());
  const double end_m = street.project({end.x(), end.y(), 0.0}).arc_m;
  for (double arc_m = end_m; arc_m <= std::min(end_m + kMost_m, street.length() - kRounded_m);
       arc_m += kSample_m) {
    Point sum = Point::Zero();
    int count = 0;
    for (double by_m = -kRounded_m; by_m <= kRounded_m; by_m += kSample_m, ++count)
      sum += street.at(arc_m + by_m);
    rounded.push_back(sum / count);
  }
  return rounded;
}

StreetAhead street_beyond(const SdMap& sd_map, const MeasuredPolyline& line) {
  StreetAhead ahead;
  const auto fit = fitted(sd_map, line);
  if (!fit) return ahead;
  const Polyline street = rounded_beyond(sd_map, line, fit->motion);
  for (const Point& place : street) {
    const Eigen::Vector2d onward = fit->motion.turned_back((place - street.front()).head<2>());
    ahead.points.push_back(line.points().back() + Point(onward.x(), onward.y(), 0.0));
  }
  const double length_m = length(ahead.points);
  if (length_m < kLeast_m) return {};
  const Eigen::Vector2d first = -end_direction(ahead.points, End::front),
                        last = end_direction(ahead.points, End::back);
  const double turn = geometry::reproducible::atan2(cross(first, last), first.dot(last));
  const double bend = fit->ahead_stddev_m * turn / length_m;
  ahead.stddev_per_m = std::sqrt(fit->heading_stddev * fit->heading_stddev + bend * bend);
  return ahead;
}

}  // namespace

bool go_on_along_street(const SdMap& sd_map, const Polyline& driven, Way& way) {
  if (sd_map.empty() || way.length() + kLeast_m > WayOptions{}.reach_m) return false;
  const Polyline end = end_of(driven, way);
  if (end.empty()) return false;
  const StreetAhead street = street_beyond(sd_map, MeasuredPolyline(end));
  if (street.points.empty()) return false;
  const double begin_m = std::max(0.0, way.stations.back().lateral_stddev_m);
  const MeasuredPolyline shape(street.points);
  const double to_m = std::min(shape.length(), (kMostStddev_m - begin_m) / street.stddev_per_m);
  if (to_m < kLeast_m) return false;
  for (double arc_m = way.step_m; arc_m <= to_m; arc_m += way.step_m)
    way.stations.push_back({.point = shape.at(arc_m),
                            .lateral_stddev_m = begin_m + street.stddev_per_m * arc_m,
                            .status = ElementStatus::inferred});
  return true;
}

}  // namespace laneloom::topology
