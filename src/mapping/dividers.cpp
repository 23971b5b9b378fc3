#include "mapping/dividers.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lane_geometry.hpp"
#include "mapping/levels.hpp"

namespace laneloom {
namespace {

constexpr double kMinLength_m = 8.0;  // what is shorter is a bay, or the mouth of a street
constexpr double kReach_m = 6.0;      // beyond a stretch, in which a line is looked for that it continues
constexpr double kReachStep_m = 2.0;
constexpr double kBeyondEdge_m = kAlongEdge_m + 1.2;  // where half a lane is, beside a line along the edge
constexpr double kSameDivider_m = 1.5;                // from where it was

/// Which stretches of the boundaries' sides belong to lanes.
using OccupiedSides = std::map<BoundarySide, Occupied>;

OccupiedSides occupied_sides(const std::vector<Lane>& lanes) {
  OccupiedSides sides;
  for (const Lane& lane : lanes) {
    for (const bool left : {true, false}) {
      const LaneSide side = lane_side(lane, left);
      sides[side.of].push_back(side.range);
    }
  }
  return sides;
}

/// The share of the width at which a line begins or ends beyond the last cross-section of a run.
std::optional<double> line_beyond(const CrossSection& last, const CrossSection& before,
                                  const BoundaryPair& pair, const std::vector<LaneBoundary>& boundaries,
                                  const std::vector<MeasuredPolyline>& measured) {
  const Point onwards = (last.middle() - before.middle()).normalized();
  for (double ahead_m = kReachStep_m; ahead_m <= kReach_m; ahead_m += kReachStep_m) {
    CrossSection section = last;
    section.left += ahead_m * onwards;
    section.right += ahead_m * onwards;
    const auto between = find_between(section, pair, boundaries, measured);
    if (between) return between->is_edge ? std::nullopt : std::optional(between->share);
  }
  return std::nullopt;
}

/// How wide the lane on the left and the one on the right of a divider may be.
struct MaxWidths {
  double left_m, right_m;
};

/// Divides a run at a share of its width that changes evenly; empty where a lane would be too narrow or wide.
std::optional<Division> divide(std::span<const CrossSection> run, double share_at_begin, double share_at_end,
                               double min_width_m, const MaxWidths& max_width) {
  Division division{.divider = {.status = ElementStatus::inferred}};
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double along = static_cast<double>(i) / static_cast<double>(run.size() - 1);
    const double share = share_at_begin + along * (share_at_end - share_at_begin);
    CrossSection left = run[i], right = run[i];
    left.right = right.left = run[i].left + share * (run[i].right - run[i].left);
    left.width_m *= share;
    right.width_m *= 1.0 - share;
    if (std::min(left.width_m, right.width_m) < min_width_m) return std::nullopt;
    if (left.width_m > max_width.left_m || right.width_m > max_width.right_m) return std::nullopt;
    division.divider.points.push_back(left.right);
    division.left.push_back(left);
    division.right.push_back(right);
  }
  const std::vector<double> arc_m = arc_lengths(division.divider.points);
  for (std::size_t i = 0; i < run.size(); ++i)
    division.left[i].right_arc_m = division.right[i].left_arc_m = arc_m[i];
  division.divider.styles = {{{0.0, arc_m.back()}, MarkingStyle::unknown}};
  return division;
}

/// Where a lane is, or a road that was divided.
struct Strip {
  MeasuredPolyline line;
  double half_width_m = 0.0;

  bool contains(const Point& point) const {
    const Projection foot = line.project(point, half_width_m);
    return foot.inside && foot.distance_m < half_width_m && same_level(foot.foot, point);
  }
};

bool contain(const std::vector<Strip>& strips, const Point& point) {
  return std::ranges::any_of(strips, [&](const Strip& strip) { return strip.contains(point); });
}

/// Finds what can be divided, pair by pair of boundaries.
class Divisions {
 public:
  Divisions(const std::vector<Lane>& lanes, const std::vector<LaneBoundary>& boundaries,
            const std::vector<MeasuredPolyline>& measured, const LaneConfig& config)
      : boundaries_(boundaries), measured_(measured), config_(config), used_(occupied_sides(lanes)) {
    for (const Lane& lane : lanes) lanes_.push_back({MeasuredPolyline(lane.centerline), 0.5 * lane.width_m});
  }

  void add(const BoundaryPair& pair) {
    if ((!pair.left_kerb && !pair.right_kerb) || pair.crosses_kerb) return;
    if (!is_confirmed(pair.left) || !is_confirmed(pair.right)) return;
    Occupied& left_used = used_[{boundaries_[pair.left].marking.id, pair.left_reversed}];
    Occupied& right_used = used_[{boundaries_[pair.right].marking.id, !pair.right_reversed}];
    const LaneBorder left(boundaries_[pair.left], measured_[pair.left], pair.left_reversed, left_used);
    const LaneBorder right(boundaries_[pair.right], measured_[pair.right], pair.right_reversed, right_used);
    const std::vector<CrossSection> sections = unmarked(pair, left, right);
    LaneConfig both_lanes = config_;
    both_lanes.max_width_variation_m *= 2.0;
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, both_lanes);
      if (run.back().left_arc_m - run.front().left_arc_m < kMinLength_m) continue;
      auto division = divide(run, pair);
      if (!division) continue;
      left_used.push_back(left.own({run.front().left_arc_m, run.back().left_arc_m}));
      right_used.push_back(right.own({run.front().right_arc_m, run.back().right_arc_m}));
      divided_.push_back({MeasuredPolyline(division->divider.points), config_.min_width_m});
      found_.push_back(std::move(*division));
    }
  }

  std::vector<Division> take() { return std::move(found_); }

 private:
  bool is_confirmed(std::size_t i) const { return boundaries_[i].marking.status == ElementStatus::confirmed; }

  /// Sections without an edge, a confirmed line or a lane in them, that are not a median.
  std::vector<CrossSection> unmarked(const BoundaryPair& pair, const LaneBorder& left,
                                     const LaneBorder& right) const {
    const bool two_kerbs = pair.left_kerb && pair.right_kerb;
    const double max_width_m = 2.0 * (two_kerbs ? config_.max_kerb_width_m : config_.max_width_m);
    auto sections = cross_sections(left, right, config_.min_divided_width_m, max_width_m, config_);
    for (CrossSection& section : sections) {
      section.valid = section.valid && !find_between(section, pair, boundaries_, measured_) &&
                      !contain(lanes_, section.middle()) && !contain(divided_, section.middle()) &&
                      !(two_kerbs && is_beside_lanes(section));
    }
    return sections;
  }

  /// Beyond the edge of a road with lanes is a verge, a pavement or a cycle track.
  bool is_beside_lanes(const CrossSection& section) const {
    const Point out = kBeyondEdge_m * (section.right - section.left).normalized();
    return contain(lanes_, section.left - out) || contain(lanes_, section.right + out);
  }

  /// At the lines that it continues, or in the middle.
  std::optional<Division> divide(std::span<const CrossSection> run, const BoundaryPair& pair) const {
    const auto before = line_beyond(run.front(), run[1], pair, boundaries_, measured_);
    const auto after = line_beyond(run.back(), run[run.size() - 2], pair, boundaries_, measured_);
    const double at_begin = before ? *before : after.value_or(0.5);
    const auto max_width_m = [&](bool kerb) { return kerb ? config_.max_kerb_width_m : config_.max_width_m; };
    auto division = laneloom::divide(run, at_begin, after.value_or(at_begin), config_.min_width_m,
                                     {max_width_m(pair.left_kerb), max_width_m(pair.right_kerb)});
    if (division) division->pair = pair;
    return division;
  }

  const std::vector<LaneBoundary>& boundaries_;
  const std::vector<MeasuredPolyline>& measured_;
  const LaneConfig& config_;
  OccupiedSides used_;
  std::vector<Strip> lanes_, divided_;
  std::vector<Division> found_;
};

}  // namespace

std::vector<Division> divide_unmarked(const std::vector<BoundaryPair>& pairs, const std::vector<Lane>& lanes,
                                      const std::vector<LaneBoundary>& boundaries,
                                      const std::vector<MeasuredPolyline>& measured,
                                      const LaneConfig& config) {
  if (config.min_divided_width_m <= 0.0) return {};
  Divisions divisions(lanes, boundaries, measured, config);
  for (const BoundaryPair& pair : pairs) divisions.add(pair);
  return divisions.take();
}

void identify_dividers(std::uint64_t frame, std::int64_t stamp_ns, const LaneConfig& config,
                       std::vector<Division>& divisions, std::vector<KnownDivider>& known,
                       ElementId& next_id) {
  struct Match {
    std::size_t covered, division, known;
  };
  std::vector<Match> matches;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const MeasuredPolyline line(known[k].points);
    for (std::size_t i = 0; i < divisions.size(); ++i) {
      const Polyline& points = divisions[i].divider.points;
      const std::size_t covered = points_beside(points, line, kSameDivider_m);
      if (2 * covered >= std::min(points.size(), known[k].points.size())) matches.push_back({covered, i, k});
    }
  }
  std::ranges::stable_sort(matches, std::greater{}, &Match::covered);
  const auto recognise = [&](Marking& divider, KnownDivider& same) {
    divider.id = same.id;
    divider.first_seen_ns = same.first_seen_ns;
    same.points = divider.points;
    same.last_frame = frame;
  };
  for (const auto& [covered, i, k] : matches)
    if (divisions[i].divider.id == kNoElement && known[k].last_frame != frame)
      recognise(divisions[i].divider, known[k]);
  for (Division& division : divisions) {
    if (division.divider.id != kNoElement) continue;
    known.push_back({.id = next_id++, .first_seen_ns = stamp_ns});
    recognise(division.divider, known.back());
  }
  std::erase_if(known, [&](const KnownDivider& divider) {
    return divider.last_frame + static_cast<std::uint64_t>(config.id_memory_frames) < frame;
  });
}

void add_divisions(const std::vector<Division>& divisions, std::vector<LaneBoundary>& boundaries,
                   std::vector<MeasuredPolyline>& measured, std::vector<Lane>& lanes) {
  const Occupied nothing;
  std::vector<LaneBoundary> dividers;
  for (const auto& [pair, marking, left_half, right_half] : divisions) {
    const LaneBoundary& divider = dividers.emplace_back(LaneBoundary{
        .marking = marking, .members = {marking.id}, .two_way = pair.left_kerb && pair.right_kerb});
    const MeasuredPolyline line(marking.points);
    const LaneBorder left(boundaries[pair.left], measured[pair.left], pair.left_reversed, nothing);
    const LaneBorder middle(divider, line, false, nothing);
    const LaneBorder right(boundaries[pair.right], measured[pair.right], pair.right_reversed, nothing);
    for (Lane lane : {make_lane(left_half, left, middle), make_lane(right_half, middle, right)}) {
      lane.section = pair.section;
      lane.inferred_ranges = {{0.0, length(lane.centerline)}};
      lanes.push_back(std::move(lane));
    }
  }
  for (LaneBoundary& divider : dividers) {
    const auto at = std::ranges::lower_bound(boundaries, divider.marking.id, {},
                                             [](const LaneBoundary& b) { return b.marking.id; });
    measured.emplace(measured.begin() + (at - boundaries.begin()), divider.marking.points);
    boundaries.insert(at, std::move(divider));
  }
}

}  // namespace laneloom
