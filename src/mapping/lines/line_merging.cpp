#include "mapping/lines/line_merging.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/lines/line_evidence.hpp"

namespace laneloom {
namespace {

constexpr double kMinBeside = 0.6;  // share of the shorter line that lies beside the other
constexpr std::size_t kStride = 3;  // between the stations that look for neighbours
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

using IndexPair = std::pair<std::size_t, std::size_t>;

/// Pairs of lines of which the shorter one is near the other along enough of it to lie beside it, in order.
std::vector<IndexPair> neighbours(const std::vector<Line>& lines, const FusionConfig& config) {
  std::vector<IndexPair> pairs;
  const StationGrid along(lines, false), across(lines, true);
  // What lies beside a line has one of its stations this near, unless these are twice as far apart as wanted.
  const double reach_m = std::sqrt(config.merge_distance_m * config.merge_distance_m +
                                   config.station_spacing_m * config.station_spacing_m);
  std::vector<std::size_t> near(lines.size()), counted_at(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    near.assign(lines.size(), 0);
    counted_at.assign(lines.size(), kNone);
    const StationGrid& grid = is_stopline(lines[i].type()) ? across : along;
    const std::size_t count = lines[i].stations.size();
    for (std::size_t k = 0; k < count; k += kStride) {
      const Point& point = lines[i].stations[k].position;
      grid.around(point, reach_m, [&](const StationGrid::Entry& entry) {
        if ((entry.position - point).head<2>().squaredNorm() >= reach_m * reach_m) return;
        if (std::exchange(counted_at[entry.line], k) != k) ++near[entry.line];
      });
    }
    // Of the stations that were looked at, one more may be beside than is seen here.
    const double needed = kMinBeside * static_cast<double>(count) / kStride - 1.0;
    for (std::size_t j = 0; j < lines.size(); ++j) {
      if (j != i && near[j] > 0 && count <= lines[j].stations.size() &&
          static_cast<double>(near[j]) >= needed)
        pairs.emplace_back(std::min(i, j), std::max(i, j));
    }
  }
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

/// The lines' courses, measured when they are first asked for.
class Courses {
 public:
  explicit Courses(const std::vector<Line>& lines) : lines_(lines), measured_(lines.size()) {}

  const MeasuredPolyline& operator[](std::size_t line) {
    auto& measured = measured_[line];
    if (!measured) {
      Polyline points;
      points.reserve(lines_[line].stations.size());
      for (const Station& station : lines_[line].stations) points.push_back(station.position);
      measured.emplace(points);
    }
    return *measured;
  }

 private:
  const std::vector<Line>& lines_;
  std::vector<std::optional<MeasuredPolyline>> measured_;
};

bool lies_beside(const Line& line, const MeasuredPolyline& other, double distance_m) {
  const auto count = line.stations.size();
  const double needed = kMinBeside * static_cast<double>(count);
  std::size_t beside = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (static_cast<double>(beside + (count - k)) < needed) return false;
    const Point& point = line.stations[k].position;
    const Projection foot = other.project(point, distance_m);
    if (foot.distance_m >= distance_m || !same_level(foot.foot, point)) continue;
    if (static_cast<double>(++beside) >= needed) return true;
  }
  return false;
}

bool side_by_side(const std::vector<Line>& lines, std::size_t a, std::size_t b, double distance_m,
                  Courses& courses) {
  if (lines[b].stations.size() <= lines[a].stations.size()) std::swap(a, b);
  return lies_beside(lines[a], courses[b], distance_m);
}

/// As far as it is in view.
bool mostly_observed(const Line& line) {
  const auto count = [&](Sight sight) { return std::ranges::count(line.stations, sight, &Station::sight); };
  return count(Sight::observed) > count(Sight::missed);
}

}  // namespace

double weight(const Line& line, const FusionConfig& config) {
  const double above = existence(line.stations, line.confidences) - config.min_log_odds;
  return static_cast<double>(line.stations.size()) * std::max(0.0, above);
}

std::vector<Relative> merge_doubles(const FusionConfig& config, std::vector<Line>& lines,
                                    PairHistories& doubles) {
  PairHistories kept;
  std::vector<Relative> merged;
  std::vector<bool> gone(lines.size(), false);
  Courses courses(lines);
  for (const auto& [i, j] : neighbours(lines, config)) {
    if (gone[i] || gone[j] || !side_by_side(lines, i, j, config.merge_distance_m, courses)) continue;
    const bool i_seen = mostly_observed(lines[i]), j_seen = mostly_observed(lines[j]);
    const PairHistory history =
        continued(doubles, lines[i].id, lines[j].id, i_seen && j_seen, i_seen != j_seen);
    if (!seen_apart(history)) {
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

}  // namespace laneloom
