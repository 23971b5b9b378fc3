#include "mapping/lines/line_joining.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/nearest_stations.hpp"
#include "mapping/markings/chains.hpp"

namespace laneloom::lines {
namespace {

constexpr double kMeeting_m = 1.5;      // ends that are nearer meet
constexpr double kMinTogether = 8.0;    // faded number of frames in which a detection ran through both ends
constexpr std::size_t kMinOverlap = 3;  // stations
constexpr double kMaxOverlap = 0.6;     // share of either line: of two that overlap more, one may be a double
constexpr double kMaxBend_deg = 40.0;   // between the two lines; sharper tips are left to the boundaries

/// An end of a line, by the number of the line.
using LineTip = markings::LineEnd;

const Point& place_of(const LineTip& at, const std::vector<Line>& lines) {
  const std::vector<Station>& stations = lines[at.line].stations;
  return at.end == End::back ? stations.back().position : stations.front().position;
}

ElementId id_of(const LineTip& at, const std::vector<Line>& lines) {
  return markings::end_id(lines[at.line].id, at.end);
}

/// An end that lies beside another line.
struct EndBeside {
  LineTip end;
  std::size_t other = 0;  ///< number of the other line
  double index = 0.0;     ///< place on the other line, see StationFoot
};

/// The ends that lie beside another line of their type, by line and end. Stoplines are left out.
std::vector<EndBeside> ends_beside(const std::vector<Line>& lines, double distance_m, StationGrid grid) {
  NearestStations nearest(lines, distance_m, std::move(grid));
  std::vector<MarkingType> types;
  std::ranges::transform(lines, std::back_inserter(types), &Line::type);
  std::vector<EndBeside> result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_stopline(types[i])) continue;
    for (const End end : kEnds) {
      const Point point = place_of({i, end}, lines);
      for (const NearestStation& near : nearest.around(point, false)) {
        if (near.line == i || types[near.line] != types[i]) continue;
        const StationFoot foot = foot_at(lines[near.line], near.station, point);
        if (foot.inside && std::abs(foot.lateral_m) < distance_m)
          result.push_back({{i, end}, near.line, foot.index});
      }
    }
  }
  return result;
}

/// The stations from an end of a line to the place `index`.
std::span<const Station> stretch_to(double index, const Line& line, End end) {
  const std::span<const Station> all = line.stations;
  return end == End::back ? all.subspan(static_cast<std::size_t>(std::ceil(index)))
                          : all.first(static_cast<std::size_t>(std::floor(index)) + 1);
}

bool is_overlap(std::span<const Station> stretch, const Line& line) {
  const double share = static_cast<double>(stretch.size()) / static_cast<double>(line.stations.size());
  return stretch.size() >= kMinOverlap && share <= kMaxOverlap;
}

/// Two ends that lie side by side, each beside the other one's line.
struct Overlap {
  LineTip whole;                    ///< its line has more evidence in the overlap
  LineTip rest;                     ///< of the other line
  std::size_t skipped = 0;          ///< stations of the other line in the overlap
  markings::PairSighting sighting;  ///< of the two lines there
};

std::optional<Overlap> overlap_of(const EndBeside& a, const EndBeside& b, const std::vector<Line>& lines) {
  const Line &line_a = lines[a.end.line], &line_b = lines[b.end.line];
  const auto along_a = stretch_to(b.index, line_a, a.end.end),
             along_b = stretch_to(a.index, line_b, b.end.end);
  if (!is_overlap(along_a, line_a) || !is_overlap(along_b, line_b)) return std::nullopt;
  const auto [low, high] = std::minmax({id_of(a.end, lines), id_of(b.end, lines)});
  const auto sighting = sighting_of(low, sight_of(along_a), high, sight_of(along_b));
  if (existence(along_a, {}) >= existence(along_b, {}))
    return Overlap{a.end, b.end, along_b.size(), sighting};
  return Overlap{b.end, a.end, along_a.size(), sighting};
}

/// The overlaps of lines that overlap at one end, by ascending ids. Lines that overlap at both ends are
/// rings, and are left out.
std::vector<Overlap> overlaps_of(const std::vector<Line>& lines, double distance_m, StationGrid grid) {
  const std::vector<EndBeside> ends = ends_beside(lines, distance_m, std::move(grid));
  const auto line_of = [](const EndBeside& beside) { return beside.end.line; };
  std::vector<Overlap> overlaps;
  for (const EndBeside& a : ends) {
    if (a.other < a.end.line) continue;
    for (auto b = std::ranges::lower_bound(ends, a.other, {}, line_of);
         b != ends.end() && line_of(*b) == a.other; ++b) {
      if (b->other != a.end.line) continue;
      if (const auto overlap = overlap_of(a, *b, lines)) overlaps.push_back(*overlap);
    }
  }
  const auto lines_of = [](const Overlap& o) {
    return std::pair<std::size_t, std::size_t>(std::minmax(o.whole.line, o.rest.line));
  };
  std::map<std::pair<std::size_t, std::size_t>, int> counts;
  for (const Overlap& overlap : overlaps) ++counts[lines_of(overlap)];
  std::erase_if(overlaps, [&](const Overlap& overlap) { return counts[lines_of(overlap)] > 1; });
  std::ranges::sort(overlaps, {}, [](const Overlap& o) { return std::pair(o.sighting.a, o.sighting.b); });
  return overlaps;
}

/// The first station of `next`, from its station `first` on, that lies ahead of the back of `line`. Empty:
/// `next` does not go on there.
std::optional<std::size_t> first_ahead(const Line& line, const Line& next, std::size_t first,
                                       const FusionConfig& config) {
  const Point& back = line.stations.back().position;
  const Eigen::Vector2d direction = direction_at(line, line.stations.size() - 1);
  const auto ahead_m = [&](std::size_t i) {
    return direction.dot((next.stations[i].position - back).head<2>());
  };
  const std::size_t limit = std::min(first + kMinOverlap, next.stations.size());
  while (first < limit && ahead_m(first) < 0.5 * config.station_spacing_m) ++first;
  if (first == limit) return std::nullopt;
  const Point& front = next.stations[first].position;
  const bool goes_on = direction.dot(direction_at(next, first)) >= cos_degrees(kMaxBend_deg);
  const double aside_m = std::abs(cross(direction, (front - back).head<2>()));
  if (!goes_on || aside_m >= config.merge_distance_m || !geometry::same_level(front, back))
    return std::nullopt;
  return (front - back).head<2>().norm() < kMeeting_m ? std::optional(first) : std::nullopt;
}

/// Joins lines, each once per frame.
class Joining {
 public:
  Joining(const FusionConfig& config, std::vector<Line>& lines)
      : config_(config), lines_(lines), is_done_(lines.size(), false) {}

  /// Joins two lines at these ends, if the one goes on where the other one ends. `whole` keeps its stations;
  /// the other line's follow, without the `skipped` ones at its end.
  void join(const LineTip& whole, const LineTip& rest, std::size_t skipped = 0) {
    if (whole.line == rest.line || is_done_[whole.line] || is_done_[rest.line]) return;
    Line line = lines_[whole.line], next = lines_[rest.line];
    if (whole.end == End::front) reverse(line);
    if (rest.end == End::back) reverse(next);
    const auto first = first_ahead(line, next, skipped, config_);
    if (!first) return;
    line.stations.insert(line.stations.end(), next.stations.begin() + static_cast<std::ptrdiff_t>(*first),
                         next.stations.end());
    line.observations = std::max(line.observations, next.observations);
    line.first_seen_ns = std::min(line.first_seen_ns, next.first_seen_ns);
    line.last_seen_ns = std::max(line.last_seen_ns, next.last_seen_ns);
    if (next.beliefs.count > line.beliefs.count) line.beliefs = next.beliefs;
    keep(line, whole, rest);
  }

  /// The same, for two ends of lines of one type that are still there.
  void join(const markings::PairHistory& joint) {
    const auto a = end_of(joint.a), b = end_of(joint.b);
    if (a && b && lines_[a->line].type() == lines_[b->line].type()) join(*a, *b);
  }

  /// Removes the lines that are part of others now, and returns the ends that met.
  std::vector<Joined> finish() {
    std::erase_if(lines_, [&](const Line& line) {
      return std::ranges::find(joined_, line.id, &Joined::gone) != joined_.end();
    });
    return std::move(joined_);
  }

 private:
  /// Gives the joined line the id and the direction of the older one.
  void keep(Line& line, const LineTip& whole, const LineTip& rest) {
    const bool whole_is_older = lines_[whole.line].id < lines_[rest.line].id;
    const LineTip &older = whole_is_older ? whole : rest, &younger = whole_is_older ? rest : whole;
    if ((older.end == End::front) == whole_is_older) reverse(line);
    line.id = lines_[older.line].id;
    joined_.push_back({line.id, older.end, lines_[younger.line].id, younger.end});
    lines_[older.line] = std::move(line);
    is_done_[older.line] = is_done_[younger.line] = true;
  }

  /// The end of an id, as markings::end_id() gives it. Empty: its line is gone.
  std::optional<LineTip> end_of(ElementId id) const {
    const auto line = std::ranges::find(lines_, markings::line_of(id), &Line::id);
    if (line == lines_.end()) return std::nullopt;
    return LineTip{static_cast<std::size_t>(line - lines_.begin()), markings::end_of(id)};
  }

  const FusionConfig& config_;
  std::vector<Line>& lines_;
  std::vector<bool> is_done_;
  std::vector<Joined> joined_;
};

}  // namespace

std::vector<Joined> join_lines(const FusionConfig& config, const markings::PairHistories& joints,
                               StationGrid grid, std::vector<Line>& lines,
                               markings::PairHistories& overlaps) {
  const std::vector<Overlap> side_by_side = overlaps_of(lines, config.merge_distance_m, std::move(grid));
  std::vector<markings::PairSighting> sightings;
  std::ranges::transform(side_by_side, std::back_inserter(sightings), &Overlap::sighting);
  overlaps = continued(overlaps, sightings);
  Joining joining(config, lines);
  for (const markings::PairHistory& joint : joints)
    if (seen_together(joint) && joint.together >= kMinTogether) joining.join(joint);
  for (std::size_t i = 0; i < overlaps.size(); ++i) {
    const auto& [whole, rest, skipped, sighting] = side_by_side[i];
    if (seen_apart(overlaps[i])) joining.join(whole, rest, skipped);
  }
  return joining.finish();
}

}  // namespace laneloom::lines
