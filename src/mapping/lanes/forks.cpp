#include "mapping/lanes/forks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/cross_sections.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kTip_m = 0.5;         // borders that are nearer have met
constexpr double kMaxTip_m = 1.2;      // borders that come no nearer than this do not meet
constexpr double kWedgeNoise_m = 0.2;  // by which a wedge may grow towards its tip, from place to place
constexpr double kMaxWedge_m = 40.0;   // length
constexpr double kChord_m = 8.0;       // over which the course before the tip is measured
constexpr double kRounded_m = 4.0;     // before the tip, where borders turn aside already
constexpr double kBeside_m = 5.0;      // along the branch, to where the stem has given way
constexpr double kGivesWay_m = 0.6;    // least distance by which a stem gives way
constexpr double kMinPart_m = 5.0;     // length of each part of a stem

/// An end of a lane beyond which its borders may meet. Ahead is from there into the lane.
class Opening {
 public:
  Opening(const Lane& lane, End end, const boundaries::Boundaries& boundaries, const LaneConfig& config)
      : front_(end == End::front),
        left_(boundaries.of(lane.left_borders.front().boundary), lane.left_borders.front().reversed),
        right_(boundaries.of(lane.right_borders.front().boundary), lane.right_borders.front().reversed),
        begin_{begin_of(left_, lane.left_borders.front().on_boundary),
               begin_of(right_, lane.right_borders.front().on_boundary)},
        tip_(find_tip(config)) {}

  /// The tip on the boundary of one side, as the boundary itself runs.
  double tip_m(Side side) const { return border(side).own({at_tip(side), at_tip(side)}).from_m; }

  /// The side on which the road clearly gives way to the lane. Empty: neither, or there is no tip.
  std::optional<Side> stem_side() const {
    if (!tip_) return std::nullopt;
    const Side before = reach_before_m(Side::left) >= reach_before_m(Side::right) ? Side::left : Side::right;
    if (reach_before_m(before) < kRounded_m + kChord_m) return std::nullopt;
    const Eigen::Vector2d course = chord_before(before, kRounded_m);
    const double left_m = gives_way_m(Side::left, course), right_m = gives_way_m(Side::right, course);
    const double clear_m = std::abs(left_m - right_m) - bend_m(before, course);
    if (std::min(clear_m, std::max(left_m, right_m)) < kGivesWay_m) return std::nullopt;
    return left_m > right_m ? Side::left : Side::right;
  }

 private:
  const LaneBorder& border(Side side) const { return side == Side::left ? left_ : right_; }
  double begin_of(const LaneBorder& border, const Stretch& of_lane) const {
    const Stretch range = border.own(of_lane);  // own() is its own inverse
    return front_ ? range.from_m : range.to_m;
  }
  double at_tip(Side side) const { return (*tip_)[index(side)]; }
  double ahead(double from_m, double by_m) const { return front_ ? from_m + by_m : from_m - by_m; }

  /// The tip, by its arc lengths on the two borders. The wedge between them narrows from the lane's end to
  /// there. Empty: the borders do not meet.
  std::optional<std::array<double, 2>> find_tip(const LaneConfig& config) const {
    const MeasuredPolyline &left = left_.line(), &right = right_.line();
    std::array<double, 2> tip{};
    double width_m = std::numeric_limits<double>::infinity();
    for (double before_m = 0.0; before_m <= kMaxWedge_m && width_m >= kTip_m; before_m += config.step_m) {
      const double right_m = ahead(begin_[index(Side::right)], -before_m);
      if (right_m < 0.0 || right_m > right.length()) break;
      const Point place = right.at(right_m);
      const Projection foot = left.project(place, config.max_kerb_width_m);
      if (!foot.inside || foot.lateral_m >= 0.0 || !geometry::same_level(foot.foot, place)) break;
      const double noise_m = width_m < kMaxTip_m ? 0.0 : kWedgeNoise_m;
      if (foot.distance_m > width_m + noise_m) break;
      width_m = foot.distance_m;
      tip = {foot.arc_m, right_m};
    }
    return width_m < kMaxTip_m ? std::optional(tip) : std::nullopt;
  }

  /// The length of a border before the tip.
  double reach_before_m(Side side) const {
    return front_ ? at_tip(side) : border(side).line().length() - at_tip(side);
  }
  /// The direction ahead of a border that ends at a distance before the tip.
  Eigen::Vector2d chord_before(Side side, double distance_m) const {
    const double to_m = ahead(at_tip(side), -distance_m);
    return border(side).line().chord(ahead(to_m, -kChord_m), to_m);
  }
  /// By how much a border turns aside from the course before the tip, away from the lane, until it is beside
  /// the lane.
  double gives_way_m(Side side, const Eigen::Vector2d& course) const {
    const MeasuredPolyline& line = border(side).line();
    const Point beside = line.at(ahead(begin_[index(side)], kBeside_m));
    const double left_m = cross(course, (beside - line.at(at_tip(side))).head<2>());
    return (side == Side::left) == front_ ? left_m : -left_m;
  }
  /// By how much the two borders would seem to differ because of a bend that lasts.
  double bend_m(Side side, const Eigen::Vector2d& course) const {
    if (reach_before_m(side) < kRounded_m + 2.0 * kChord_m) return 0.0;
    const double curvature = std::abs(cross(chord_before(side, kRounded_m + kChord_m), course)) / kChord_m;
    const double along_m = std::abs(begin_[index(side)] - at_tip(side)) + kBeside_m;
    return curvature * along_m * along_m;
  }

  bool front_;
  LaneBorder left_, right_;
  std::array<double, 2> begin_;               ///< arc lengths of the lane's end on the borders, by side
  std::optional<std::array<double, 2>> tip_;  ///< of the tip
};

/// A lane from which another one branches off.
struct Stem {
  std::size_t lane = 0;  ///< its index
  double at_m = 0.0;     ///< the tip, along its centerline
  Fork fork;
};

/// The stem of a branch. Empty: there is none.
std::optional<Stem> stem_of(const Lane& branch, End end, const std::vector<Lane>& lanes,
                            const boundaries::Boundaries& boundaries, const LaneConfig& config) {
  const Opening opening(branch, end, boundaries, config);
  const auto side = opening.stem_side();
  if (!side) return std::nullopt;
  const LaneSide shared = lane_side(branch, *side);
  const Fork fork{shared.of, opening.tip_m(*side), end, shared.reversed};
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const LaneSide beyond = lane_side(lanes[i], opposite(*side));
    if (beyond.of != shared.of.other() || beyond.reversed != shared.reversed) continue;
    if (fork.arc_m < beyond.range.from_m || fork.arc_m > beyond.range.to_m) continue;
    const MeasuredPolyline centerline(lanes[i].centerline);
    const double at_m = centerline.project(boundaries.of(shared.of.boundary).course.at(fork.arc_m)).arc_m;
    const double before_m = end == End::front ? at_m : centerline.length() - at_m;
    if (before_m < kMinPart_m) continue;
    return Stem{i, at_m, fork};
  }
  return std::nullopt;
}

/// The parts of a lane before and behind an arc length of its centerline.
std::pair<Lane, Lane> cut(const Lane& lane, double at_m, const boundaries::Boundaries& boundaries) {
  const MeasuredPolyline centerline(lane.centerline);
  std::pair parts(lane, lane);
  Lane &before = parts.first, &behind = parts.second;
  const auto cut_side = [&](Side side, Polyline Lane::*line) {
    const MeasuredPolyline border(lane.*line);
    const double border_m = border.project(centerline.at(at_m)).arc_m;
    before.*line = border.slice({0.0, border_m});
    behind.*line = border.slice({border_m, border.length()});
    const LaneSide whole = lane_side(lane, side);
    const double arc_m =
        std::clamp(boundaries.of(whole.of.boundary).course.project(border.at(border_m)).arc_m,
                   whole.range.from_m, whole.range.to_m);
    Border &border_before = before.borders(side).front(), &border_behind = behind.borders(side).front();
    (whole.reversed ? border_behind : border_before).on_boundary = {whole.range.from_m, arc_m};
    (whole.reversed ? border_before : border_behind).on_boundary = {arc_m, whole.range.to_m};
    border_before.range = {0.0, at_m};
    border_behind.range = {0.0, centerline.length() - at_m};
  };
  cut_side(Side::left, &Lane::left);
  cut_side(Side::right, &Lane::right);
  before.centerline = centerline.slice({0.0, at_m});
  behind.centerline = centerline.slice({at_m, centerline.length()});
  const auto inferred_within = [&](const Stretch& part) {
    std::vector<Stretch> ranges;
    for (const Stretch& range : lane.inferred_ranges) {
      const Stretch common = geometry::common(range, part);
      if (common.length() > 0.0) ranges.push_back({common.from_m - part.from_m, common.to_m - part.from_m});
    }
    return ranges;
  };
  before.inferred_ranges = inferred_within({0.0, at_m});
  behind.inferred_ranges = inferred_within({at_m, centerline.length()});
  return parts;
}

/// Whether both sides of a lane have an extent. In a tight corner, the foot of a cut may be at a side's end.
bool is_whole(const Lane& lane) {
  return std::ranges::all_of(
             kSides, [&](Side side) { return lane.borders(side).front().on_boundary.length() > 0.0; }) &&
         length(lane.left) > 0.0 && length(lane.right) > 0.0;
}

}  // namespace

std::vector<Fork> cut_at_forks(const boundaries::Boundaries& boundaries, const LaneConfig& config,
                               std::vector<Lane>& lanes) {
  std::vector<Stem> stems;
  for (const Lane& lane : lanes)
    for (const End end : kEnds)
      if (const auto stem = stem_of(lane, end, lanes, boundaries, config)) stems.push_back(*stem);
  std::ranges::sort(stems, std::greater{}, [](const Stem& stem) { return std::tuple(stem.lane, stem.at_m); });
  std::vector<Fork> forks;
  std::vector<Lane> parts;
  for (const Stem& stem : stems) {  // the last cut of a lane comes first
    Lane& lane = lanes[stem.lane];
    if (length(lane.centerline) - stem.at_m >= kMinPart_m && stem.at_m >= kMinPart_m) {
      auto [before, behind] = cut(lane, stem.at_m, boundaries);
      if (!is_whole(before) || !is_whole(behind)) continue;
      lane = std::move(before);
      parts.push_back(std::move(behind));
    }
    forks.push_back(stem.fork);
  }
  std::ranges::move(parts, std::back_inserter(lanes));
  return forks;
}

}  // namespace laneloom::lanes
