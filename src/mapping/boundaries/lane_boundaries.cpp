#include "mapping/boundaries/lane_boundaries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom {
namespace {

constexpr double kMinGap_m = 1.0;      // a shorter one is no more than the distance between vertices
constexpr double kMeeting_m = 1.5;     // ends that are nearer meet,
constexpr double kMaxBend_deg = 40.0;  // and there a line may bend as it does round a corner of 8 m
constexpr double kChange_m = 0.5;      // over which the one changes to the other where they overlap
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// One end of a marking.
struct End {
  std::size_t marking = kNone;
  bool at_back = false;
};

struct Join {
  double gap_m = 0.0;
  End a, b;
};

const Point& end_point(const Marking& marking, bool at_back) {
  return at_back ? marking.points.back() : marking.points.front();
}

/// Whether the two ends face each other.
bool are_aligned(const Marking& a, bool a_back, const Marking& b, bool b_back, const BoundaryConfig& config) {
  const Eigen::Vector2d gap = (end_point(b, b_back) - end_point(a, a_back)).head<2>();
  const Eigen::Vector2d leaving = end_direction(a.points, a_back);
  const Eigen::Vector2d entering = -end_direction(b.points, b_back);
  const double max_angle_deg = gap.norm() < kMeeting_m ? kMaxBend_deg : config.max_angle_deg;
  if (leaving.dot(entering) < cos_degrees(max_angle_deg)) return false;
  return std::abs(cross(leaving, gap)) <= config.max_lateral_m;
}

MarkingStyle end_style(const Marking& marking, bool at_back) {
  if (marking.styles.empty()) return MarkingStyle::unknown;
  return at_back ? marking.styles.back().style : marking.styles.front().style;
}

/// Whether one line changes its style there: a network sees it as two.
bool is_style_change(const Marking& a, bool a_back, const Marking& b, bool b_back) {
  const MarkingStyle one = end_style(a, a_back), other = end_style(b, b_back);
  return one != other && one != MarkingStyle::unknown && other != MarkingStyle::unknown;
}

std::vector<Join> possible_joins(const std::vector<Marking>& lines, const PairHistories& joints,
                                 const BoundaryConfig& config) {
  std::vector<Join> joins;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      if (lines[i].type != lines[j].type) continue;
      for (const bool i_back : {false, true}) {
        for (const bool j_back : {false, true}) {
          const Point &a = end_point(lines[i], i_back), &b = end_point(lines[j], j_back);
          const double gap_m = (b - a).head<2>().norm();
          if (gap_m > config.max_gap_m || !same_level(a, b)) continue;
          const PairHistory* joint = find(joints, end_id(lines[i].id, i_back), end_id(lines[j].id, j_back));
          const bool is_change = gap_m < kMeeting_m && is_style_change(lines[i], i_back, lines[j], j_back);
          if (joint != nullptr && seen_apart(*joint) && !is_change) continue;
          const bool one = joint != nullptr && seen_together(*joint);
          if (one || are_aligned(lines[i], i_back, lines[j], j_back, config))
            joins.push_back({gap_m, {i, i_back}, {j, j_back}});
        }
      }
    }
  }
  std::ranges::stable_sort(joins, {}, &Join::gap_m);
  return joins;
}

/// For every end the end that it is joined to; no chain closes on itself.
std::vector<std::array<End, 2>> choose_joins(const std::vector<Join>& joins, std::size_t count) {
  std::vector<std::array<End, 2>> joined(count);
  std::vector<std::size_t> group(count);
  std::iota(group.begin(), group.end(), 0U);
  for (const auto& [gap_m, a, b] : joins) {
    const bool taken =
        joined[a.marking][a.at_back].marking != kNone || joined[b.marking][b.at_back].marking != kNone;
    if (taken || group[a.marking] == group[b.marking]) continue;
    joined[a.marking][a.at_back] = b;
    joined[b.marking][b.at_back] = a;
    const std::size_t from = group[b.marking], to = group[a.marking];
    std::ranges::replace(group, from, to);
  }
  return joined;
}

/// The part of `next` that lies ahead of the end of `line`; the two may overlap at their ends. Empty: none.
std::optional<Marking> ahead_of(const Marking& line, const Marking& next) {
  const MeasuredPolyline measured(next.points);
  const double foot_m = measured.project(line.points.back()).arc_m;
  if (foot_m <= 0.0) return next;
  const double from_m = foot_m + kChange_m;
  if (from_m >= measured.length()) return std::nullopt;
  return slice(next, {from_m, measured.length()});
}

void continue_with(const Marking& ahead, LaneBoundary& boundary) {
  const double end_m = length(boundary.marking.points);
  const double gap_m = (ahead.points.front() - boundary.marking.points.back()).head<2>().norm();
  if (gap_m > kMinGap_m) boundary.bridged.push_back({end_m, end_m + gap_m});
  append(boundary.marking, ahead);
}

/// Follows the joins from one free end of a chain to the other.
LaneBoundary assemble(const std::vector<Marking>& lines, const std::vector<std::array<End, 2>>& joined,
                      End start) {
  LaneBoundary boundary;
  End entered = start;
  while (entered.marking != kNone) {
    Marking next = lines[entered.marking];
    if (entered.at_back) reverse(next);
    boundary.members.push_back(next.id);
    if (boundary.marking.points.empty()) {
      boundary.marking = std::move(next);
    } else if (const auto ahead = ahead_of(boundary.marking, next)) {
      continue_with(*ahead, boundary);
    }
    entered = joined[entered.marking][!entered.at_back];
  }
  std::ranges::sort(boundary.members);
  boundary.marking.id = boundary.members.front();
  return boundary;
}

}  // namespace

std::size_t index_of(const std::vector<LaneBoundary>& boundaries, ElementId id) {
  const auto found = std::ranges::lower_bound(
      boundaries, id, {}, [](const LaneBoundary& boundary) { return boundary.marking.id; });
  return static_cast<std::size_t>(found - boundaries.begin());
}

const LaneBoundary& boundary_of(const std::vector<LaneBoundary>& boundaries, ElementId id) {
  return boundaries[index_of(boundaries, id)];
}

void reverse(LaneBoundary& boundary) {
  const double total_m = length(boundary.marking.points);
  reverse(boundary.marking);
  std::ranges::reverse(boundary.bridged);
  for (Range& range : boundary.bridged) range = {total_m - range.to_m, total_m - range.from_m};
}

std::vector<LaneBoundary> lane_boundaries(const std::vector<Marking>& markings, const PairHistories& joints,
                                          const BoundaryConfig& config) {
  std::vector<Marking> lines;
  std::ranges::copy_if(markings, std::back_inserter(lines),
                       [](const Marking& m) { return m.type != MarkingType::stopline; });
  const auto joined = choose_joins(possible_joins(lines, joints, config), lines.size());

  std::vector<LaneBoundary> boundaries;
  std::vector<bool> used(lines.size(), false);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (used[i]) continue;
    // Back to the chain's first line, so that the boundary runs as its oldest member does.
    End start{i, false};
    while (joined[start.marking][start.at_back].marking != kNone) {
      const End before = joined[start.marking][start.at_back];
      start = {before.marking, !before.at_back};
    }
    boundaries.push_back(assemble(lines, joined, start));
    for (std::size_t k = 0; k < lines.size(); ++k) {
      if (std::ranges::binary_search(boundaries.back().members, lines[k].id)) used[k] = true;
    }
  }
  std::ranges::sort(boundaries, {}, [](const LaneBoundary& b) { return b.marking.id; });
  return boundaries;
}

}  // namespace laneloom
