#include "mapping/lines/line_joining.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/lines/nearest_stations.hpp"
#include "mapping/markings/chains.hpp"

namespace laneloom::lines {
namespace {

constexpr double kMeeting_m = 1.5;      // ends that are nearer meet
constexpr double kMinTogether = 8.0;    // faded number of frames in which a detection ran through both ends
constexpr std::size_t kMinOverlap = 3;  // stations
constexpr double kMaxOverlap = 0.6;     // share of either line: of two that overlap more, one may be a double

using markings::LineEnd;

const Point& tip(const Line& line, End end) {
  return end == End::back ? line.stations.back().position : line.stations.front().position;
}

ElementId id_of(const LineEnd& at, const std::vector<Line>& lines) {
  return markings::end_id(lines[at.line].id, at.end);
}

/// An end that lies beside another line.
struct EndBeside {
  LineEnd end;
  std::size_t other = 0;  ///< number of the other line
  double index = 0.0;     ///< place on the other line, see StationFoot
};

/// The ends that lie beside another line of their type, by line and end. Stoplines are left out.
std::vector<EndBeside> ends_beside(const std::vector<Line>& lines, double distance_m) {
  NearestStations nearest(lines, distance_m);
  std::vector<MarkingType> types;
  std::ranges::transform(lines, std::back_inserter(types), &Line::type);
  std::vector<EndBeside> result;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_stopline(types[i])) continue;
    for (const End end : kEnds) {
      const Point& point = tip(lines[i], end);
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
  LineEnd a, b;
  markings::PairSighting sighting;  ///< of the two stretches that lie side by side
};

std::vector<Overlap> overlaps_of(const std::vector<Line>& lines, double distance_m) {
  const std::vector<EndBeside> ends = ends_beside(lines, distance_m);
  std::vector<Overlap> overlaps;
  for (const EndBeside& a : ends) {
    for (const EndBeside& b : ends) {
      if (a.end.line > b.end.line || a.other != b.end.line || b.other != a.end.line) continue;
      const Line &line_a = lines[a.end.line], &line_b = lines[b.end.line];
      const auto along_a = stretch_to(b.index, line_a, a.end.end);
      const auto along_b = stretch_to(a.index, line_b, b.end.end);
      if (!is_overlap(along_a, line_a) || !is_overlap(along_b, line_b)) continue;
      const bool a_seen = mostly_observed(along_a), b_seen = mostly_observed(along_b);
      const auto [low, high] = std::minmax({id_of(a.end, lines), id_of(b.end, lines)});
      overlaps.push_back({a.end, b.end, {low, high, a_seen && b_seen, a_seen != b_seen}});
    }
  }
  std::ranges::sort(overlaps, {}, [](const Overlap& o) { return std::pair(o.sighting.a, o.sighting.b); });
  return overlaps;
}

/// The first station of `next` that lies ahead of the back of `line`. Empty: `next` does not go on there.
std::optional<std::size_t> first_ahead(const Line& line, const Line& next, double max_aside_m) {
  const Point& back = line.stations.back().position;
  const auto distance_m = [&](const Station& station) { return (station.position - back).head<2>().norm(); };
  const auto nearest = std::ranges::min_element(next.stations, {}, distance_m);
  if (!geometry::same_level(nearest->position, back)) return std::nullopt;
  const auto foot = foot_at(next, static_cast<std::size_t>(nearest - next.stations.begin()), back);
  if (foot.index < 0.0)
    return distance_m(next.stations.front()) < kMeeting_m ? std::optional(0UL) : std::nullopt;
  const auto first = static_cast<std::size_t>(std::floor(foot.index)) + 1;
  if (!foot.inside || std::abs(foot.lateral_m) >= max_aside_m || first >= next.stations.size())
    return std::nullopt;
  return first;
}

/// Lets `line` go on with the stations of `next` from `first` on.
void append(const Line& next, std::size_t first, Line& line) {
  line.stations.insert(line.stations.end(), next.stations.begin() + static_cast<std::ptrdiff_t>(first),
                       next.stations.end());
  line.observations += next.observations;
  line.first_seen_ns = std::min(line.first_seen_ns, next.first_seen_ns);
  line.last_seen_ns = std::max(line.last_seen_ns, next.last_seen_ns);
  if (next.confidences.count > line.confidences.count) line.confidences = next.confidences;
}

/// Joins lines, each once per frame.
class Joining {
 public:
  Joining(std::vector<Line>& lines, double max_aside_m)
      : lines_(lines), max_aside_m_(max_aside_m), is_done_(lines.size(), false) {}

  /// Joins two lines at these ends, if one goes on there where the other one ends.
  void join(LineEnd a, LineEnd b) {
    if (is_done_[a.line] || is_done_[b.line]) return;
    if (lines_[b.line].id < lines_[a.line].id) std::swap(a, b);
    Line &line = lines_[a.line], &next = lines_[b.line];
    if (a.end == End::front) reverse(line);
    if (b.end == End::back) reverse(next);
    if (const auto first = first_ahead(line, next, max_aside_m_)) {
      append(next, *first, line);
      is_done_[a.line] = is_done_[b.line] = true;
      gone_.push_back({next.id, line.id});
    } else if (b.end == End::back) {
      reverse(next);
    }
    if (a.end == End::front) reverse(line);
  }

  /// The same, for two ends of lines of one type that are still there.
  void join(const markings::PairHistory& joint) {
    const auto a = end_of(joint.a), b = end_of(joint.b);
    if (a && b && lines_[a->line].type() == lines_[b->line].type()) join(*a, *b);
  }

  /// Removes the lines that are part of others now, and returns them.
  std::vector<markings::Relative> finish() {
    std::erase_if(lines_, [&](const Line& line) {
      return std::ranges::find(gone_, line.id, &markings::Relative::id) != gone_.end();
    });
    return std::move(gone_);
  }

 private:
  /// The end of an id, see markings::end_id(). Empty: its line is gone.
  std::optional<LineEnd> end_of(ElementId id) const {
    const auto line = std::ranges::find(lines_, id / 2, &Line::id);
    if (line == lines_.end()) return std::nullopt;
    return LineEnd{static_cast<std::size_t>(line - lines_.begin()), kEnds[id % 2]};
  }

  std::vector<Line>& lines_;
  double max_aside_m_;
  std::vector<bool> is_done_;
  std::vector<markings::Relative> gone_;
};

}  // namespace

std::vector<markings::Relative> join_lines(const FusionConfig& config, const markings::PairHistories& joints,
                                           std::vector<Line>& lines, markings::PairHistories& overlaps) {
  const std::vector<Overlap> side_by_side = overlaps_of(lines, config.merge_distance_m);
  std::vector<markings::PairSighting> sightings;
  std::ranges::transform(side_by_side, std::back_inserter(sightings), &Overlap::sighting);
  overlaps = continued(overlaps, sightings);
  Joining joining(lines, config.merge_distance_m);
  for (const markings::PairHistory& joint : joints)
    if (seen_together(joint) && joint.together >= kMinTogether) joining.join(joint);
  for (std::size_t i = 0; i < overlaps.size(); ++i)
    if (seen_apart(overlaps[i])) joining.join(side_by_side[i].a, side_by_side[i].b);
  return joining.finish();
}

}  // namespace laneloom::lines
