#include "mapping/boundaries/islands.hpp"

#include <cmath>
#include <vector>

namespace laneloom::boundaries {
namespace {

constexpr double kMinTurn_rad = 1.75;
constexpr double kMostReach =
    0.85;  // distance between the ends per length; an arc that turns so far has less
constexpr double kMinRadius_m = 4.0, kMaxRadius_m = 25.0;
constexpr double kChord_m = 3.0;
constexpr std::size_t kChords = 4;  // over which a turn is told from noise

}  // namespace

std::optional<Side> island_side(const MeasuredPolyline& line) {
  const double length_m = line.length();
  const Polyline& ends = line.points();
  if (length_m < kMinTurn_rad * kMinRadius_m || (ends.back() - ends.front()).norm() > kMostReach * length_m)
    return std::nullopt;
  const Polyline points = line.resample(kChord_m);
  std::vector<Eigen::Vector2d> along;
  for (std::size_t i = 1; i < points.size(); ++i)
    along.emplace_back((points[i] - points[i - 1]).head<2>().normalized());
  std::vector<double> turned{0.0};  // up to each chord, radians, to the left
  for (std::size_t i = 1; i < along.size(); ++i)
    turned.push_back(turned.back() + cross(along[i - 1], along[i]));
  const double sense = turned.back() > 0.0 ? 1.0 : -1.0;
  if (sense * turned.back() < kMinTurn_rad) return std::nullopt;
  const double chords_m = kChord_m * static_cast<double>(kChords);
  for (std::size_t i = kChords; i < turned.size(); ++i) {
    const double turn = sense * (turned[i] - turned[i - kChords]);
    if (turn < chords_m / kMaxRadius_m || turn > chords_m / kMinRadius_m) return std::nullopt;
  }
  return sense > 0.0 ? Side::left : Side::right;
}

}  // namespace laneloom::boundaries
