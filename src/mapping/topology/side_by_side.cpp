#include "mapping/topology/side_by_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::topology {
namespace {

// Log odds of opposite directions.
constexpr double kSolidEvidence = 0.5;
constexpr double kMiddleEvidence = 1.0;  // of a solid line in the middle of the road
constexpr double kDashedEvidence = -0.9;
constexpr double kTwoWayEvidence = 1.0;     // of an unmarked road from kerb to kerb
constexpr double kUnmarkedEvidence = -0.9;  // of an inferred boundary elsewhere
constexpr double kMedianEvidence = 2.0;     // of a median, or of an edge

constexpr double kDoubleLine_m = 0.8;  // greatest distance between its two lines
constexpr double kMaxMedian_m = 16.0;
constexpr double kNarrow_m = 2.0;               // a narrower median divides one road
constexpr double kMinMedian_m = 12.0;           // length of a median
constexpr double kMaxVariation_m = 0.4;         // of the width of a median
constexpr double kMaxDoubleVariation_m = 0.15;  // of a double line; with more, its lines diverge
constexpr double kMedianStep_m = 3.0;

constexpr double kMaxShoulder_m = 4.5;
constexpr double kMaxBeyond_m = 14.0;  // up to where the next boundary tells that a road goes on
constexpr double kAlongside = 0.8;     // cosine between boundaries of one road, or the own way
constexpr double kBesideRoad_m = 8.0;  // further away from a lane's side, the vehicle drives on another road
constexpr std::size_t kLatestPlaces = 8;  // of the own way

/// Whether the vehicle drives beyond the border on a side of a lane, on the same road. That side is not the
/// road's then, although no lane was found there.
bool is_driven_beyond(const MeasuredPolyline& border, Side side, std::span<const Point> own_way) {
  const auto latest = own_way.last(std::min(own_way.size(), kLatestPlaces));
  for (std::size_t i = 0; i < latest.size(); ++i) {
    const Projection foot = border.project(latest[i], kBesideRoad_m);
    const double out_m = side == Side::left ? foot.lateral_m : -foot.lateral_m;
    if (!foot.inside || out_m <= 0.0 || foot.distance_m >= kBesideRoad_m ||
        !geometry::may_drive_on(foot.foot, latest[i]))
      continue;
    if (latest.size() == 1) return true;  // the drive begins: its direction is not known yet
    const std::size_t from = i > 0 ? i - 1 : 0;
    const Eigen::Vector2d ahead = (latest[from + 1] - latest[from]).head<2>().normalized();
    if (std::abs(border.direction(foot).dot(ahead)) > kAlongside) return true;
  }
  return false;
}

/// Whether a boundary with `left` and `right` lanes on its two sides lies in the middle of a road. If a road
/// has three lanes, either direction may have two of them: no boundary counts as its middle. If it has five,
/// the middle lane may be a turning lane of either direction: both its boundaries count.
bool is_middle(std::size_t left, std::size_t right) {
  const std::size_t more = std::max(left, right), fewer = std::min(left, right);
  return more == fewer || (more == fewer + 1 && fewer > 1);
}

/// The strip between a lane and the next lane on its right.
struct Median {
  std::size_t right = 0;  ///< index of the lane beyond the median
  double width_m = std::numeric_limits<double>::infinity();
};

bool may_be_crossed(const Marking& border, const Stretch& range) {
  return border.type != MarkingType::roadedge && markings::dashed_excess_m(border, range) >= 0.0;
}

/// Log odds of opposite directions by the boundary that two lanes share.
double boundary_evidence(const boundaries::LaneBoundary& boundary, const Stretch& range, bool in_middle) {
  const Marking& marking = boundary.marking;
  if (marking.status == ElementStatus::inferred)
    return boundary.two_way ? kTwoWayEvidence : kUnmarkedEvidence;
  if (marking.type == MarkingType::roadedge) return kMedianEvidence;
  const double dashed_m = markings::dashed_excess_m(marking, range);
  if (dashed_m == 0.0) return 0.0;
  if (dashed_m > 0.0) return kDashedEvidence;
  return in_middle ? kMiddleEvidence : kSolidEvidence;
}

class SideBySide {
 public:
  SideBySide(const lanes::LaneLayout& layout, std::span<const Point> own_way)
      : layout_(layout),
        own_way_(own_way),
        lanes_(layout.lanes),
        boundaries_(layout.boundaries),
        left_sides_(layout.lanes.size()) {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      if (lanes_[i].left_neighbours.empty()) left_sides_[i] = MeasuredPolyline(lanes_[i].left);
  }

  std::vector<SideBySideLanes> pairs() const {
    std::vector<SideBySideLanes> pairs;
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      if (const auto right = across(i, Side::right)) {
        pairs.push_back({i, *right, evidence_beside(lanes_[i], is_in_middle(i, *right))});
      } else if (lanes_[i].right_neighbours.empty()) {
        if (const auto median = median_right_of(i)) pairs.push_back(across_median(i, *median));
      }
    }
    return pairs;
  }

 private:
  /// Log odds of opposite directions by the borders on the right of a lane.
  double evidence_beside(const Lane& lane, bool in_middle) const {
    return lanes::mean_over(lane.right_borders, [&](const Border& border) {
      return boundary_evidence(boundaries_.of(border.boundary), border.on_boundary, in_middle);
    });
  }

  /// Whether a line that may be crossed, or none, bounds a part of a lane's side.
  bool may_be_crossed(const std::vector<Border>& borders) const {
    return std::ranges::any_of(borders, [&](const Border& border) {
      return border.boundary == kNoElement ||
             topology::may_be_crossed(boundaries_.of(border.boundary).marking, border.on_boundary);
    });
  }

  /// The lane across the boundary on a side, if its centerline runs alike.
  std::optional<std::size_t> across(std::size_t i, Side side) const {
    const Lane& lane = lanes_[i];
    const auto other = std::ranges::find(lanes_, lanes::main_neighbour(lane, side), &Lane::id);
    if (other == lanes_.end()) return std::nullopt;
    return lanes::share_boundary(lane, side, *other)
               ? std::optional(static_cast<std::size_t>(other - lanes_.begin()))
               : std::nullopt;
  }

  /// The lanes on a side of a lane, to the end of the road.
  struct Beside {
    std::size_t count = 0;
    std::size_t last = 0;  ///< the outermost one; the lane itself, if there is none
  };
  Beside beside(std::size_t i, Side side) const {
    Beside lanes{.last = i};
    for (auto next = across(i, side); next && lanes.count < lanes_.size(); next = across(*next, side))
      lanes = {lanes.count + 1, *next};
    return lanes;
  }

  /// Whether the boundary on the right of a lane lies in the middle of the road. `right` is the lane
  /// beyond.
  bool is_in_middle(std::size_t left, std::size_t right) const {
    const Beside on_left = beside(left, Side::left), on_right = beside(right, Side::right);
    return is_middle(on_left.count + 1, on_right.count + 1) &&
           !goes_on_beyond(layout_, lanes_[on_left.last], Side::left, own_way_) &&
           !goes_on_beyond(layout_, lanes_[on_right.last], Side::right, own_way_);
  }

  /// The median on the right of a lane, up to the nearest lane beyond it. Empty: there is none.
  std::optional<Median> median_right_of(std::size_t i) const {
    const MeasuredPolyline side(lanes_[i].right);
    const double middle_m = 0.5 * side.length();
    const Point middle = side.at(middle_m);
    Median nearest;
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      if (k == i || !lanes_[k].left_neighbours.empty()) continue;
      const Projection foot = left_sides_[k].project(middle, kMaxMedian_m);
      const bool along = side.direction(middle_m).dot(left_sides_[k].direction(foot.arc_m)) > 0.0;
      const bool near = foot.inside && foot.distance_m < std::min(nearest.width_m, kMaxMedian_m);
      if (near && along && geometry::same_level(foot.foot, middle)) nearest = {k, foot.distance_m};
    }
    return is_median(side, nearest) ? std::optional(nearest) : std::nullopt;
  }

  bool is_median(const MeasuredPolyline& side, const Median& median) const {
    if (median.width_m > kMaxMedian_m) return false;
    double narrowest_m = median.width_m, widest_m = median.width_m, beside_m = 0.0;
    for (const Point& point : side.resample(kMedianStep_m)) {
      const Projection foot = left_sides_[median.right].project(point, kMaxMedian_m);
      if (!foot.inside) continue;
      if (foot.lateral_m < 0.0) return false;
      narrowest_m = std::min(narrowest_m, foot.distance_m);
      widest_m = std::max(widest_m, foot.distance_m);
      beside_m += kMedianStep_m;
    }
    const double max_variation_m = median.width_m < kDoubleLine_m ? kMaxDoubleVariation_m : kMaxVariation_m;
    return beside_m >= kMinMedian_m && widest_m - narrowest_m <= max_variation_m;
  }

  SideBySideLanes across_median(std::size_t i, const Median& median) const {
    const Lane &left = lanes_[i], &right = lanes_[median.right];
    const bool closed = !may_be_crossed(left.right_borders) && !may_be_crossed(right.left_borders);
    return {i, median.right, closed ? kMedianEvidence : evidence_beside(left, false),
            median.width_m > kNarrow_m};
  }

  const lanes::LaneLayout& layout_;
  std::span<const Point> own_way_;
  const std::vector<Lane>& lanes_;
  const boundaries::Boundaries& boundaries_;
  std::vector<MeasuredPolyline> left_sides_;  ///< of lanes that have no lane on their left
};

}  // namespace

std::vector<SideBySideLanes> side_by_side(const lanes::LaneLayout& layout, std::span<const Point> own_way) {
  return SideBySide(layout, own_way).pairs();
}

bool goes_on_beyond(const lanes::LaneLayout& layout, const Lane& lane, Side side,
                    std::span<const Point> own_way) {
  const MeasuredPolyline course(side == Side::left ? lane.left : lane.right);
  if (is_driven_beyond(course, side, own_way)) return true;
  const auto ends_road = [&](const Border& border) {
    return border.boundary == kNoElement || layout.boundaries.of(border.boundary).is_edge();
  };
  if (std::ranges::any_of(lane.borders(side), ends_road)) return false;
  const double middle_m = 0.5 * course.length();
  const Point middle = course.at(middle_m);
  const Eigen::Vector2d along = course.direction(middle_m);
  double nearest_m = kMaxBeyond_m;
  for (const boundaries::LaneBoundary& boundary : layout.boundaries) {
    if (std::ranges::count(lane.borders(side), boundary.marking.id, &Border::boundary) > 0) continue;
    const Projection foot = boundary.course.project(middle, nearest_m);
    if (!foot.inside || foot.distance_m >= nearest_m || !geometry::same_level(foot.foot, middle)) continue;
    const bool is_left = cross(along, (foot.foot - middle).head<2>()) > 0.0;
    if (is_left == (side == Side::left) && std::abs(boundary.course.direction(foot).dot(along)) > kAlongside)
      nearest_m = foot.distance_m;
  }
  return nearest_m > kMaxShoulder_m && nearest_m < kMaxBeyond_m;
}

}  // namespace laneloom::topology
