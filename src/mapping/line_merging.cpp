#include "mapping/line_merging.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kMemory = 0.97;       // of the counts, per frame: about 30 frames
constexpr double kMinFrames = 4.0;     // before a pair is judged
constexpr double kMaxTogether = 0.25;  // share of the frames; real lines are seen together more often
constexpr double kMinBeside = 0.6;     // share of the shorter line that lies beside the other
constexpr double kMaxHeight_m = 1.0;
constexpr std::size_t kStride = 3;  // between the stations that look for neighbours

using IndexPair = std::pair<std::size_t, std::size_t>;

/// Pairs of lines that come near each other somewhere, each once, in order.
std::vector<IndexPair> neighbours(const std::vector<Line>& lines, const FusionConfig& config) {
  std::vector<IndexPair> pairs;
  const StationGrid along(lines, false), across(lines, true);
  const double reach_m = config.merge_distance_m + config.station_spacing_m;
  std::vector<bool> near(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    near.assign(lines.size(), false);
    const StationGrid& grid = is_stopline(lines[i].type()) ? across : along;
    for (std::size_t k = 0; k < lines[i].stations.size(); k += kStride) {
      const Point& point = lines[i].stations[k].position;
      grid.around(point, [&](const StationGrid::Entry& entry) {
        if ((entry.position - point).head<2>().squaredNorm() < reach_m * reach_m) near[entry.line] = true;
      });
    }
    for (std::size_t j = 0; j < lines.size(); ++j)
      if (near[j] && j != i) pairs.push_back(std::minmax(i, j));
  }
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  return pairs;
}

bool lies_beside(const Line& line, const Line& other, double distance_m) {
  Polyline points;
  for (const Station& station : other.stations) points.push_back(station.position);
  const MeasuredPolyline measured(points);
  const auto beside = std::ranges::count_if(line.stations, [&](const Station& station) {
    const Projection foot = measured.project(station.position);
    return foot.distance_m < distance_m && std::abs(foot.foot.z() - station.position.z()) < kMaxHeight_m;
  });
  return static_cast<double>(beside) >= kMinBeside * static_cast<double>(line.stations.size());
}

bool side_by_side(const Line& a, const Line& b, const FusionConfig& config) {
  const bool a_shorter = a.stations.size() < b.stations.size();
  return lies_beside(a_shorter ? a : b, a_shorter ? b : a, config.merge_distance_m);
}

bool mostly_observed(const StationsObserved& observed, std::size_t line) {
  return line < observed.size() &&
         2 * std::ranges::count(observed[line], true) > std::ranges::ssize(observed[line]);
}

double evidence(const Line& line, const FusionConfig& config) {
  double sum = 0.0;
  for (const Station& station : line.stations) sum += station.log_odds - config.min_log_odds;
  return sum;
}

LinePair counted(const std::vector<LinePair>& pairs, const Line& a, const Line& b, bool a_seen, bool b_seen) {
  LinePair pair{std::min(a.id, b.id), std::max(a.id, b.id)};
  const auto known =
      std::ranges::find_if(pairs, [&](const LinePair& p) { return p.a == pair.a && p.b == pair.b; });
  if (known != pairs.end()) pair = *known;
  pair.together = kMemory * pair.together + (a_seen && b_seen ? 1.0 : 0.0);
  pair.apart = kMemory * pair.apart + (a_seen != b_seen ? 1.0 : 0.0);
  return pair;
}

bool is_double(const LinePair& pair) {
  const double frames = pair.together + pair.apart;
  return frames >= kMinFrames && pair.together < kMaxTogether * frames;
}

}  // namespace

void merge_doubles(const StationsObserved& observed, const FusionConfig& config, std::vector<Line>& lines,
                   std::vector<LinePair>& pairs) {
  std::vector<LinePair> kept;
  std::vector<bool> gone(lines.size(), false);
  for (const auto& [i, j] : neighbours(lines, config)) {
    if (gone[i] || gone[j] || !side_by_side(lines[i], lines[j], config)) continue;
    const LinePair pair =
        counted(pairs, lines[i], lines[j], mostly_observed(observed, i), mostly_observed(observed, j));
    if (is_double(pair)) {
      gone[evidence(lines[i], config) < evidence(lines[j], config) ? i : j] = true;
    } else {
      kept.push_back(pair);
    }
  }
  pairs = std::move(kept);
  std::size_t index = 0;
  std::erase_if(lines, [&](const Line&) { return gone[index++]; });
}

}  // namespace laneloom
