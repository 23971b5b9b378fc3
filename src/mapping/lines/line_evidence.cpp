#include "mapping/lines/line_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace laneloom {
namespace {

/// By crossings of a ray (even-odd).
bool contains(const Polyline& polygon, const Point& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

}  // namespace

bool View::sees(const Point& point_map, MarkingType type, const LocalRange& range) const {
  const auto& types = frame->detected_types;
  if (!types.empty() && std::ranges::find(types, type) == types.end()) return false;
  const Point point = T_body_map * point_map;
  const bool in_view =
      frame->field_of_view.empty() ? range.shows(point_map) : contains(frame->field_of_view, point);
  return in_view && std::ranges::none_of(frame->occluded_areas,
                                         [&](const Polyline& area) { return contains(area, point); });
}

void discount_unobserved(const View& view, const LocalRange& range, const FusionConfig& config,
                         std::vector<Line>& lines) {
  for (Line& line : lines) {
    for (Station& station : line.stations) {
      if (station.sight == Sight::observed || !view.sees(station.position, line.type(), range)) continue;
      station.sight = Sight::missed;
      const double range_m = (view.T_body_map * station.position).head<2>().norm();
      station.log_odds -= config.miss_log_odds * std::max(0.0, 1.0 - range_m / config.miss_range_m);
    }
  }
}

namespace {

/// What is left of a line, in order.
std::vector<Line> living_pieces(Line& line, const LocalRange& range, const FusionConfig& config) {
  const auto dead = [&](const Station& s) {
    return s.log_odds < config.min_log_odds || !range.keeps(s.position);
  };
  std::vector<Line> pieces;
  if (line.stations.size() >= 2 && std::ranges::none_of(line.stations, dead)) {
    pieces.push_back(std::move(line));
    return pieces;
  }
  const std::vector<Station> stations = std::exchange(line.stations, {});
  for (auto begin = stations.begin(); begin != stations.end();) {
    const auto end = std::find_if(begin, stations.end(), dead);
    if (end - begin >= 2) {
      pieces.push_back(line);
      pieces.back().stations.assign(begin, end);
    }
    begin = std::find_if_not(end, stations.end(), dead);
  }
  return pieces;
}

}  // namespace

std::vector<Relative> prune_lines(const LocalRange& range, const FusionConfig& config,
                                  std::vector<Line>& lines, ElementId& next_id) {
  std::vector<Line> kept, cut_off;
  std::vector<Relative> relatives;
  for (Line& line : lines) {
    std::vector<Line> pieces = living_pieces(line, range, config);
    if (pieces.empty()) continue;
    const auto longest =
        std::ranges::max_element(pieces, {}, [](const Line& piece) { return piece.stations.size(); });
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
      if (piece == longest) continue;
      piece->id = next_id++;
      relatives.push_back({piece->id, line.id});
      cut_off.push_back(std::move(*piece));
    }
    kept.push_back(std::move(*longest));
  }
  lines = std::move(kept);
  std::ranges::move(cut_off, std::back_inserter(lines));
  return relatives;
}

}  // namespace laneloom
