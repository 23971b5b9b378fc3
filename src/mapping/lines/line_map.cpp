#include "mapping/lines/line_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::lines {
namespace {

constexpr double kCell_m = 1.0;  // as the gate and the spacing of stations: searches meet few cells

/// The foot of `point` on the two segments at the place `nearest` of `count`; `at(i)` is the position of
/// place i.
template <class PositionAt>
StationFoot foot_near(std::size_t nearest, std::size_t count, const Point& point, const PositionAt& at) {
  const std::size_t first = nearest == 0 ? 0 : nearest - 1;
  const std::size_t last = std::min(nearest + 1, count - 1);
  StationFoot best;
  double best_distance_m = -1.0;
  for (std::size_t i = first; i < last; ++i) {
    const Point& a = at(i);
    const Point segment = at(i + 1) - a;
    const Eigen::Vector2d along = segment.head<2>();
    const double length_m = along.norm();
    if (length_m <= 0.0) continue;
    const Eigen::Vector2d offset = (point - a).head<2>();
    const double share = offset.dot(along) / (length_m * length_m);
    const double clamped = std::clamp(share, 0.0, 1.0);
    const Point foot = a + clamped * segment;
    const double distance_m = (point - foot).head<2>().norm();
    if (best_distance_m >= 0.0 && distance_m >= best_distance_m) continue;
    best_distance_m = distance_m;
    const bool beyond = (i == 0 && share < 0.0) || (i + 2 == count && share > 1.0);
    best = {.index = static_cast<double>(i) + (beyond ? share : clamped),
            .lateral_m = cross(along, offset) / length_m,
            .height_m = point.z() - foot.z(),
            .inside = !beyond};
  }
  return best;
}

}  // namespace

Sight sight_of(std::span<const Station> stretch) {
  const auto count = [&](Sight sight) { return std::ranges::count(stretch, sight, &Station::sight); };
  const auto observed = count(Sight::observed), missed = count(Sight::missed);
  if (observed > missed) return Sight::observed;
  return missed > 0 ? Sight::missed : Sight::out_of_view;
}

markings::PairSighting sighting_of(ElementId a, Sight a_sight, ElementId b, Sight b_sight) {
  const bool both_in_view = a_sight != Sight::out_of_view && b_sight != Sight::out_of_view;
  return {.a = a,
          .b = b,
          .together = a_sight == Sight::observed && b_sight == Sight::observed,
          .apart = both_in_view && a_sight != b_sight};
}

MarkingType Line::type() const {
  std::array<double, kMarkingTypeCount> votes{};
  for (const Station& station : stations)
    for (std::size_t i = 0; i < votes.size(); ++i) votes[i] += station.type_votes[i];
  return static_cast<MarkingType>(std::ranges::max_element(votes) - votes.begin());
}

void reverse(Line& line) {
  std::ranges::reverse(line.stations);
  for (Station& station : line.stations) {
    station.lateral.mirror();
    station.moved_m = -station.moved_m;
    for (FarView& view : station.far_views) view.mirror();
  }
}

StationFoot foot_at(const Line& line, std::size_t nearest, const Point& point) {
  return foot_near(nearest, line.stations.size(), point,
                   [&](std::size_t i) -> const Point& { return line.stations[i].position; });
}

Course::Course(const Line& line) {
  places_.reserve(line.stations.size());
  for (std::size_t i = 0; i < line.stations.size(); ++i)
    places_.push_back({line.stations[i].position, direction_at(line, i)});
}

StationFoot Course::foot(std::size_t nearest, const Point& point) const {
  return foot_near(nearest, places_.size(), point,
                   [&](std::size_t i) -> const Point& { return places_[i].position; });
}

Eigen::Vector2d direction_at(const Line& line, std::size_t station) {
  const std::size_t before = station == 0 ? 0 : station - 1;
  const std::size_t after = std::min(station + 1, line.stations.size() - 1);
  return (line.stations[after].position - line.stations[before].position).head<2>().normalized();
}

StationGrid station_grid(const std::vector<Line>& lines) {
  std::size_t count = 0;
  for (const Line& line : lines) count += line.stations.size();
  std::vector<StationPlace> all;
  all.reserve(count);
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    const auto& stations = lines[i].stations;
    for (std::uint32_t k = 0; k < stations.size(); ++k) all.push_back({stations[k].position, i, k});
  }
  return {std::move(all), kCell_m};
}

}  // namespace laneloom::lines
