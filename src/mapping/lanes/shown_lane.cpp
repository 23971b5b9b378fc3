#include "mapping/lanes/shown_lane.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/smooth_step.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kOnBoundary_m = 0.5;  // a boundary that is nearer to a border is the one that it lay on
constexpr double kMinLength_m = 2.0;
constexpr double kMinStep_m = 0.05;      // of a border, from one cross-section to the next
constexpr double kMostTurn = 0.5;        // cosine; where a border turns by more, it has a spike
constexpr double kMostOffCenter = 0.25;  // share of the width by which a centerline leaves the center
constexpr double kMinBorder_m = 2.0;     // along the lane
constexpr std::size_t kMaxBorders = 16;  // as in the topic

/// Extends a border over the next one, which is left out.
void absorb(Border& border, const Border& other) {
  border.range = {std::min(border.range.from_m, other.range.from_m),
                  std::max(border.range.to_m, other.range.to_m)};
  if (border.boundary == kNoElement || border.boundary != other.boundary) return;
  border.on_boundary = {std::min(border.on_boundary.from_m, other.on_boundary.from_m),
                        std::max(border.on_boundary.to_m, other.on_boundary.to_m)};
}

/// Leaves out borders that are short, and the shortest ones of more than a map may have. A longer one beside
/// each of them takes its place.
void leave_out_short(std::vector<Border>& borders) {
  const auto shorter = [](const Border& a, const Border& b) { return a.range.length() < b.range.length(); };
  while (borders.size() > 1) {
    auto shortest = std::ranges::min_element(borders, shorter);
    if (shortest->range.length() >= kMinBorder_m && borders.size() <= kMaxBorders) return;
    const bool at_begin = shortest == borders.begin(), at_end = shortest + 1 == borders.end();
    auto heir =
        at_end || (!at_begin && shorter(*(shortest + 1), *(shortest - 1))) ? shortest - 1 : shortest + 1;
    absorb(*heir, *shortest);
    borders.erase(shortest);
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
      if (borders[i].boundary != borders[i + 1].boundary) continue;
      absorb(borders[i], borders[i + 1]);
      borders.erase(borders.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
  }
}

/// The shown stations, with their borders laid onto the boundaries that are in the map.
class ShownStations {
 public:
  ShownStations(const LaneTrack& track, const boundaries::Boundaries& boundaries) : boundaries_(boundaries) {
    stations_.reserve(track.stations.size());
    for (const LaneStation& station : track.stations) {
      if (!station.shown) continue;
      LaneStation laid = station;
      if (!laid.found)
        for (const Side side : kSides) lay(side, laid);
      if (stations_.size() > 1 && is_spike(stations_.rbegin()[1], stations_.back(), laid))
        stations_.pop_back();
      if (!stations_.empty() && !lies_ahead(stations_.back(), laid)) continue;
      stations_.push_back(laid);
    }
    centers_.reserve(stations_.size());
    for (const LaneStation& station : stations_) centers_.push_back(station.center());
    arcs_m_ = arc_lengths(centers_);
    if (is_empty()) return;
    centerline_ = smooth_centerline();
    arcs_m_ = arc_lengths(centerline_);
  }

  bool is_empty() const { return arcs_m_.empty() || arcs_m_.back() < kMinLength_m; }

  Lane lane() && {
    Lane lane{.use = Lane::Use::lane};
    for (const Side side : kSides) {
      lane.borders(side) = borders(side);
      Polyline& line = side == Side::left ? lane.left : lane.right;
      line.reserve(stations_.size());
      for (const LaneStation& station : stations_) line.push_back(station.border[index(side)]);
      drop_repeats(line);
    }
    rate(lane);
    lane.centerline = std::move(centerline_);
    return lane;
  }

 private:
  /// Whether a cross-section lies ahead of another one on both sides, so that the two do not cross.
  static bool lies_ahead(const LaneStation& before, const LaneStation& station) {
    const Eigen::Vector2d across = (station.border[0] - station.border[1]).head<2>();
    const Eigen::Vector2d ahead(across.y(), -across.x());  // the left border lies on the left
    return std::ranges::all_of(kSides, [&](Side side) {
      const Point step = station.border[index(side)] - before.border[index(side)];
      return step.head<2>().dot(ahead) > kMinStep_m * ahead.norm();
    });
  }

  /// Whether a border leaves its course at a cross-section, and returns to it at the next one.
  static bool is_spike(const LaneStation& before, const LaneStation& station, const LaneStation& after) {
    return std::ranges::any_of(kSides, [&](Side side) {
      const auto border = [side](const LaneStation& one) -> Eigen::Vector2d {
        return one.border[index(side)].head<2>();
      };
      const Eigen::Vector2d in = border(station) - border(before), out = border(after) - border(station);
      return in.dot(out) < kMostTurn * in.norm() * out.norm();
    });
  }

  /// Lays a border onto its boundary. The boundary is forgotten where it is no longer there.
  void lay(Side side, LaneStation& station) const {
    ElementId& boundary = station.boundary[index(side)];
    Point& border = station.border[index(side)];
    const boundaries::LaneBoundary* known = boundaries_.find(boundary);
    const Projection foot = known != nullptr ? known->course.project(border, kOnBoundary_m) : Projection{};
    if (foot.inside && foot.distance_m < kOnBoundary_m) {
      border = foot.foot;
    } else {
      boundary = kNoElement;
      station.status = ElementStatus::inferred;
    }
  }

  std::vector<Border> borders(Side side) const {
    std::vector<Border> borders;
    for (std::size_t i = 0, end = 0; i < stations_.size(); i = end) {
      const ElementId boundary = stations_[i].boundary[index(side)];
      end = i + 1;
      while (end < stations_.size() && stations_[end].boundary[index(side)] == boundary) ++end;
      Border border{
          .boundary = boundary,
          .range = {borders.empty() ? 0.0 : borders.back().range.to_m,
                    end < stations_.size() ? 0.5 * (arcs_m_[end - 1] + arcs_m_[end]) : arcs_m_.back()}};
      if (boundary != kNoElement) {
        const MeasuredPolyline& course = boundaries_.of(boundary).course;
        const double from_m = course.project(stations_[i].border[index(side)]).arc_m;
        const double to_m = course.project(stations_[end - 1].border[index(side)]).arc_m;
        border.on_boundary = {std::min(from_m, to_m), std::max(from_m, to_m)};
        border.reversed = to_m < from_m;
        if (border.on_boundary.length() <= 0.0) border = {.range = border.range};
      }
      borders.push_back(border);
    }
    leave_out_short(borders);
    return borders;
  }

  /// The centers. Where the borders step aside, the steps fade over the centers before and behind.
  Polyline smooth_centerline() const {
    Polyline line = centers_;
    for (std::size_t i = 1; i + 2 < centers_.size(); ++i)
      if (stations_[i].stepped) fade(i, line);
    for (std::size_t i = 0; i < line.size(); ++i) keep_inside(stations_[i], line[i]);
    return line;
  }

  /// Moves a point of the centerline back into its lane: steps that follow each other, and those of narrow
  /// lanes, lead out of it.
  static void keep_inside(const LaneStation& station, Point& point) {
    const Point center = station.center(), off = point - center;
    const double most_m = kMostOffCenter * station.width_m(), off_m = off.head<2>().norm();
    if (off_m > most_m) point = center + most_m / off_m * off;
  }

  /// Fades the step between a center and the next one.
  void fade(std::size_t i, Polyline& line) const {
    const Point from = centers_[i] + 0.5 * (centers_[i] - centers_[i - 1]);
    const Point to = centers_[i + 1] - 0.5 * (centers_[i + 2] - centers_[i + 1]);
    const Eigen::Vector2d along = (centers_[i + 2] - centers_[i - 1]).head<2>().normalized();
    Point half = 0.5 * (to - from);
    half.head<2>() -= half.head<2>().dot(along) * along;
    const double shift_m = half.head<2>().norm();
    const double before_m = 0.5 * (arcs_m_[i] + arcs_m_[i + 1]), behind_m = arcs_m_.back() - before_m;
    for (std::size_t k = 0; k <= i; ++k)
      line[k] += geometry::faded(before_m - arcs_m_[k], shift_m, before_m) * half;
    for (std::size_t k = i + 1; k < line.size(); ++k)
      line[k] -= geometry::faded(arcs_m_[k] - before_m, shift_m, behind_m) * half;
  }

  /// Gives the lane the trust that its stations have.
  void rate(Lane& lane) const {
    double width_m = 0.0, probability = 0.0;
    std::size_t rated = 0, confirmed = 0, inferred = 0;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const LaneStation& station = stations_[i];
      width_m += station.width_m();
      lane.evidence |= station.evidence;
      if (station.probability >= 0.0) {
        probability += station.probability;
        ++rated;
      }
      if (station.status == ElementStatus::confirmed) ++confirmed;
      if (station.status != ElementStatus::inferred) continue;
      ++inferred;
      const double from_m = i == 0 ? 0.0 : 0.5 * (arcs_m_[i - 1] + arcs_m_[i]);
      const double to_m = i + 1 == arcs_m_.size() ? arcs_m_.back() : 0.5 * (arcs_m_[i] + arcs_m_[i + 1]);
      if (!lane.inferred_ranges.empty() && from_m - lane.inferred_ranges.back().to_m < kMinBorder_m) {
        lane.inferred_ranges.back().to_m = to_m;
      } else {
        lane.inferred_ranges.push_back({from_m, to_m});
      }
    }
    lane.width_m = width_m / static_cast<double>(stations_.size());
    lane.existence_probability = rated > 0 ? probability / static_cast<double>(rated) : -1.0;
    if (inferred == stations_.size()) {
      lane.status = ElementStatus::inferred;
    } else {
      lane.status =
          2 * confirmed > stations_.size() - inferred ? ElementStatus::confirmed : ElementStatus::tentative;
    }
  }

  const boundaries::Boundaries& boundaries_;
  std::vector<LaneStation> stations_;
  Polyline centers_;
  Polyline centerline_;         ///< the centers, with the steps of the borders smoothed
  std::vector<double> arcs_m_;  ///< on it
};

}  // namespace

std::optional<Lane> shown_lane(const LaneTrack& track, const boundaries::Boundaries& boundaries) {
  ShownStations shown(track, boundaries);
  if (shown.is_empty()) return std::nullopt;
  Lane lane = std::move(shown).lane();
  lane.id = track.id;
  lane.section = track.section;
  return lane;
}

}  // namespace laneloom::lanes
