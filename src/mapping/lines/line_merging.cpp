#include "mapping/lines/line_merging.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/lines/line_evidence.hpp"

namespace laneloom::lines {
namespace {

constexpr double kMinBeside = 0.6;  // share of the shorter line that lies beside the other
constexpr double kKerb_m = 0.3;     // two road edges nearer to each other are one
constexpr double kPaint_m = 0.15;   // two lanelines nearer to each other have no gap between their paint

using IndexPair = std::pair<std::size_t, std::size_t>;

/// The positions of the lines' stations.
class Courses {
 public:
  explicit Courses(const std::vector<Line>& lines) {
    begins_.reserve(lines.size() + 1);
    begins_.push_back(0);
    for (const Line& line : lines) begins_.push_back(begins_.back() + line.stations.size());
    all_.reserve(begins_.back());
    for (const Line& line : lines)
      for (const Station& station : line.stations) all_.push_back(station.position);
  }
  std::size_t size(std::size_t line) const { return begins_[line + 1] - begins_[line]; }
  std::span<const Point> operator[](std::size_t line) const {
    return std::span(all_).subspan(begins_[line], size(line));
  }

 private:
  Polyline all_;                       ///< of all lines, one after the other
  std::vector<std::size_t> begins_{};  ///< per line, its first one; at last, their number
};

/// Whether a line passes within `distance_m` of a point, at a station or on the two segments at it.
bool passes(std::span<const Point> course, std::size_t station, const Point& point, double distance_m) {
  const auto is_near = [&](const Point& place) {
    return (place - point).head<2>().squaredNorm() < distance_m * distance_m &&
           geometry::same_level(place, point);
  };
  if (is_near(course[station])) return true;
  const auto is_near_between = [&](const Point& from, const Point& to) {
    const Point segment = to - from;
    const double ahead = (point - from).head<2>().dot(segment.head<2>());
    const double length_m2 = segment.head<2>().squaredNorm();
    return ahead > 0.0 && ahead < length_m2 && is_near(from + ahead / length_m2 * segment);
  };
  return (station > 0 && is_near_between(course[station - 1], course[station])) ||
         (station + 1 < course.size() && is_near_between(course[station], course[station + 1]));
}

/// Finds the longer lines that a line lies beside.
class BesideSearch {
 public:
  /// `grid` must outlive this.
  BesideSearch(const std::vector<Line>& lines, const StationGrid& grid, const FusionConfig& config)
      : grid_(grid), courses_(lines), others_(lines.size()), spacing_m_(config.station_spacing_m) {
    types_.reserve(lines.size());
    for (const Line& line : lines) types_.push_back(line.type());
  }

  MarkingType type(std::size_t line) const { return types_[line]; }
  /// Calls `found(other)` for each longer line beside which at least `share` of `line` lies, within
  /// `distance_m`. Of equally long lines, the first one counts as longer.
  template <class Found>
  void beside(std::size_t line, double distance_m, double share, Found&& found) {
    // A line that passes this near has a station within reach, unless its stations are more than twice as far
    // apart as wanted.
    const double reach_m = std::sqrt(distance_m * distance_m + spacing_m_ * spacing_m_);
    const std::span<const Point> course = courses_[line];
    const auto needed = static_cast<std::size_t>(std::ceil(share * static_cast<double>(course.size())));
    for (std::size_t j = 0; j < others_.size(); ++j) {
      const bool is_longer = std::pair(courses_.size(j), line) > std::pair(course.size(), j);
      const bool is_alike = is_stopline(types_[j]) == is_stopline(types_[line]);
      others_[j] = {.needed = needed, .next = is_longer && is_alike ? 0 : kNever};
    }
    std::size_t most = 0;  // stations that were found beside one other line
    for (std::size_t k = 0; k < course.size() && needed <= most + course.size() - k; ++k) {
      const Point& point = course[k];
      grid_.around(point, reach_m, [&](const StationPlace& entry) {
        Other& other = others_[entry.line];
        if (other.next > k || (entry.position - point).head<2>().squaredNorm() >= reach_m * reach_m) return;
        if (other.needed > course.size() - k) {
          other.next = kNever;
          return;
        }
        if (!passes(courses_[entry.line], entry.station, point, distance_m)) return;
        other.next = --other.needed == 0 ? kNever : k + 1;
        most = std::max(most, needed - other.needed);
        if (other.needed == 0) found(entry.line);
      });
    }
  }

 private:
  static constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();
  /// The state of the search for one of the other lines.
  struct Other {
    std::size_t needed = 0;     ///< number of stations that must still be found beside it
    std::size_t next = kNever;  ///< the next station to look at
  };

  const StationGrid& grid_;
  std::vector<MarkingType> types_;
  Courses courses_;
  std::vector<Other> others_;
  double spacing_m_;
};

/// Pairs of lines that lie side by side along enough of the shorter one, in ascending order.
std::vector<IndexPair> side_by_side(std::size_t lines, double distance_m, BesideSearch& search) {
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < lines; ++i)
    search.beside(i, distance_m, kMinBeside, [&](std::size_t j) { pairs.emplace_back(std::minmax(i, j)); });
  std::ranges::sort(pairs);
  return pairs;
}

/// Those of the pairs that have no room between them, in ascending order.
std::vector<IndexPair> without_room(const std::vector<IndexPair>& pairs, BesideSearch& search) {
  std::set<std::size_t> candidates;
  for (const auto& [i, j] : pairs)
    if (search.type(i) == search.type(j)) candidates.insert({i, j});
  std::vector<IndexPair> result;
  for (const std::size_t i : candidates) {
    const MarkingType type = search.type(i);
    const auto found = [&](std::size_t j) {
      if (search.type(j) == type) result.emplace_back(std::minmax(i, j));
    };
    if (type == MarkingType::roadedge) search.beside(i, kKerb_m, kMinBeside, found);
    if (type == MarkingType::laneline) search.beside(i, kPaint_m, 1.0, found);
  }
  std::ranges::sort(result);
  return result;
}

}  // namespace

double weight(const Line& line, const FusionConfig& config) {
  const double above = existence(line.stations, line.beliefs) - config.min_log_odds;
  return static_cast<double>(line.stations.size()) * std::max(0.0, above);
}

std::vector<markings::Relative> merge_doubles(const FusionConfig& config, const StationGrid& grid,
                                              std::vector<Line>& lines, markings::PairHistories& doubles) {
  markings::PairHistories kept;
  std::vector<markings::Relative> merged;
  std::vector<bool> gone(lines.size(), false);
  BesideSearch search(lines, grid, config);
  const std::vector<IndexPair> pairs = side_by_side(lines.size(), config.merge_distance_m, search);
  const std::vector<IndexPair> one = without_room(pairs, search);
  for (const auto& [i, j] : pairs) {
    if (gone[i] || gone[j]) continue;
    const auto [a, b] = std::minmax(lines[i].id, lines[j].id);
    const markings::PairHistory history =
        continued(doubles, sighting_of(a, sight_of(lines[i].stations), b, sight_of(lines[j].stations)));
    if (!seen_apart(history) && !std::ranges::binary_search(one, IndexPair(i, j))) {
      kept.push_back(history);
      continue;
    }
    const bool i_goes = weight(lines[i], config) < weight(lines[j], config);
    gone[i_goes ? i : j] = true;
    merged.push_back({lines[i_goes ? i : j].id, lines[i_goes ? j : i].id});
  }
  sort(kept);
  doubles = std::move(kept);
  std::size_t index = 0;
  std::erase_if(lines, [&](const Line&) { return gone[index++]; });
  return merged;
}

}  // namespace laneloom::lines
