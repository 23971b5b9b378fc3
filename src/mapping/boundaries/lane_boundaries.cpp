#include "mapping/boundaries/lane_boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/markings/chains.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::boundaries {
namespace {

constexpr double kMinGap_m = 1.0;      // a shorter gap is no more than the distance between vertices
constexpr double kMeeting_m = 1.5;     // ends that are nearer meet;
constexpr double kMaxBend_deg = 40.0;  // there a line may bend as much as round a corner of 8 m
constexpr double kChange_m = 0.5;      // where two markings overlap, the change from one to the other

/// One end of a marking.
struct Tip {
  const Marking& marking;
  End end;

  const Point& point() const { return end_point(marking.points, end); }
  Eigen::Vector2d outwards() const { return end_direction(marking.points, end); }
  MarkingStyle style() const {
    if (marking.styles.empty()) return MarkingStyle::unknown;
    return end == End::back ? marking.styles.back().style : marking.styles.front().style;
  }
  ElementId id() const { return markings::end_id(marking.id, end); }
};

/// Whether the two ends face each other.
bool are_aligned(const Tip& a, const Tip& b, const BoundaryConfig& config) {
  const Eigen::Vector2d gap = (b.point() - a.point()).head<2>();
  const Eigen::Vector2d leaving = a.outwards(), entering = -b.outwards();
  const double max_angle_deg = gap.norm() < kMeeting_m ? kMaxBend_deg : config.max_angle_deg;
  if (leaving.dot(entering) < cos_degrees(max_angle_deg)) return false;
  return std::abs(cross(leaving, gap)) <= config.max_lateral_m &&
         std::abs(cross(entering, gap)) <= config.max_lateral_m;
}

/// Whether the two ends differ in style: a network sees a line that changes its style as two.
bool is_style_change(const Tip& a, const Tip& b) {
  const MarkingStyle one = a.style(), other = b.style();
  return one != other && one != MarkingStyle::unknown && other != MarkingStyle::unknown;
}

/// Whether two ends with a gap of `gap_m` between them may be joined.
bool may_join(const Tip& a, const Tip& b, double gap_m, const markings::PairHistories& joints,
              const BoundaryConfig& config) {
  const markings::PairHistory* joint = find(joints, a.id(), b.id());
  const bool is_change = gap_m < kMeeting_m && is_style_change(a, b);
  if (joint != nullptr && seen_apart(*joint) && !is_change) return false;
  return (joint != nullptr && seen_together(*joint)) || are_aligned(a, b, config);
}

std::vector<markings::Join> possible_joins(const std::vector<const Marking*>& lines,
                                           const markings::PairHistories& joints,
                                           const BoundaryConfig& config) {
  std::vector<markings::Join> joins;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      if (lines[i]->type != lines[j]->type) continue;
      for (const End i_end : kEnds) {
        for (const End j_end : kEnds) {
          const Tip a{*lines[i], i_end}, b{*lines[j], j_end};
          const double gap_m = (b.point() - a.point()).head<2>().norm();
          if (gap_m > config.max_gap_m || !geometry::same_level(a.point(), b.point())) continue;
          if (may_join(a, b, gap_m, joints, config)) joins.push_back({gap_m, {i, i_end}, {j, j_end}});
        }
      }
    }
  }
  return joins;
}

/// The part of `next` that lies ahead of the end of `line`. The two may overlap at their ends. Empty: no part
/// of `next` does.
std::optional<Marking> ahead_of(const Marking& line, const Marking& next) {
  const MeasuredPolyline measured(next.points);
  const double foot_m = measured.project(line.points.back()).arc_m;
  if (foot_m <= 0.0) return next;
  const double from_m = foot_m + kChange_m;
  if (from_m >= measured.length()) return std::nullopt;
  return markings::slice(next, {from_m, measured.length()});
}

void continue_with(const Marking& ahead, LaneBoundary& boundary) {
  const double end_m = length(boundary.marking.points);
  const double gap_m = (ahead.points.front() - boundary.marking.points.back()).head<2>().norm();
  if (gap_m > kMinGap_m) boundary.bridged.push_back({end_m, end_m + gap_m});
  markings::append(boundary.marking, ahead);
}

LaneBoundary assemble(const std::vector<markings::Link>& chain, const std::vector<const Marking*>& lines) {
  LaneBoundary boundary;
  for (const markings::Link& link : chain) {
    Marking next = *lines[link.line];
    if (link.reversed) markings::reverse(next);
    boundary.members.push_back(next.id);
    if (boundary.marking.points.empty()) {
      boundary.marking = std::move(next);
    } else if (const auto ahead = ahead_of(boundary.marking, next)) {
      continue_with(*ahead, boundary);
    }
  }
  std::ranges::sort(boundary.members);
  boundary.marking.id = boundary.members.front();
  return boundary;
}

}  // namespace

Boundaries lane_boundaries(const std::vector<Marking>& markings, const markings::PairHistories& joints,
                           const BoundaryConfig& config) {
  std::vector<const Marking*> lines;
  lines.reserve(markings.size());
  for (const Marking& marking : markings)
    if (marking.type != MarkingType::stopline) lines.push_back(&marking);
  // A chain runs as its first line does, so that the boundary runs as its oldest member.
  std::vector<LaneBoundary> boundaries;
  for (const std::vector<markings::Link>& chain : chains(possible_joins(lines, joints, config), lines.size()))
    boundaries.push_back(assemble(chain, lines));
  return boundaries;
}

}  // namespace laneloom::boundaries
