#include "mapping/lines/nearest_stations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mapping/geometry/levels.hpp"

namespace laneloom::lines {
namespace {

constexpr double kRounding = 1.0 + 1e-9;
constexpr double kMaxOutside_m = 2.0;  // greatest distance outside of a bend, from its station
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The greatest squared distance of a point on a line from the nearest station. Its foot is at most half a
/// segment away from the station, or, outside of a bend, at the station itself.
double squared_reach_m2(const Line& line, double gate_m) {
  double longest_m = 0.0, least_cosine = 1.0;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  for (std::size_t i = 1; i < line.stations.size(); ++i) {
    const Eigen::Vector2d along = (line.stations[i].position - line.stations[i - 1].position).head<2>();
    const double segment_m = along.norm();
    if (segment_m <= 0.0) continue;
    const Eigen::Vector2d direction = along / segment_m;
    longest_m = std::max(longest_m, segment_m);
    if (!before.isZero()) least_cosine = std::min(least_cosine, before.dot(direction));
    before = direction;
  }
  const double beside_m2 = gate_m * gate_m + 0.25 * longest_m * longest_m;
  const double outside_m = gate_m < kMaxOutside_m * least_cosine ? gate_m / least_cosine : kMaxOutside_m;
  return kRounding * std::max(beside_m2, outside_m * outside_m);
}

}  // namespace

NearestStations::NearestStations(const std::vector<Line>& lines, double gate_m, StationGrid grid)
    : grid_(std::move(grid)), slots_(lines.size(), kNone) {
  is_stopline_.reserve(lines.size());
  squared_reach_m2_.reserve(lines.size());
  for (const Line& line : lines) {
    is_stopline_.push_back(is_stopline(line.type()));
    squared_reach_m2_.push_back(squared_reach_m2(line, gate_m));
    furthest_m_ = std::max(furthest_m_, std::sqrt(squared_reach_m2_.back()));
  }
}

const std::vector<NearestStation>& NearestStations::around(const Point& point, bool of_stoplines) {
  for (const NearestStation& nearest : near_) slots_[nearest.line] = kNone;
  near_.clear();
  const double* const reach_m2 = squared_reach_m2_.data();
  grid_.around(point, furthest_m_, [=, this, center = point](const StationPlace& entry) {
    const Point offset = entry.position - center;
    const double squared_m2 = offset.head<2>().squaredNorm();
    if (squared_m2 > reach_m2[entry.line] || !geometry::same_level(entry.position, center)) return;
    if (is_stopline_[entry.line] != of_stoplines) return;
    std::uint32_t& slot = slots_[entry.line];
    if (slot == kNone) {
      slot = static_cast<std::uint32_t>(near_.size());
      near_.push_back({entry.line, entry.station, squared_m2});
    } else if (squared_m2 < near_[slot].squared_m2) {
      near_[slot] = {entry.line, entry.station, squared_m2};
    }
  });
  return near_;
}

}  // namespace laneloom::lines
