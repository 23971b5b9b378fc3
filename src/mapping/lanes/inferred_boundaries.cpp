#include "mapping/lanes/inferred_boundaries.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "mapping/geometry/levels.hpp"

namespace laneloom {
namespace {

constexpr double kSame_m = 1.5;  // from where it was

ElementId id_of(const LaneBoundary& boundary) { return boundary.marking.id; }

}  // namespace

Marking inferred_marking(const Polyline& points) {
  return {.status = ElementStatus::inferred,
          .points = points,
          .styles = {{{0.0, length(points)}, MarkingStyle::unknown}}};
}

Box box_around(const Polyline& line, double margin_m) {
  const Point margin(margin_m, margin_m, kLevel_m);
  Box box;
  for (const Point& point : line) box.extend(point);
  return {box.min() - margin, box.max() + margin};
}

TakenSpace::TakenSpace(const std::vector<Lane>& lanes) {
  for (const Lane& lane : lanes) {
    add(lane.centerline, 0.5 * lane.width_m);
    for (const bool left : {true, false}) {
      const LaneSide side = lane_side(lane, left);
      beside(side.of).push_back(side.range);
    }
  }
}

void TakenSpace::add(const Polyline& line, double half_width_m) {
  strips_.push_back({MeasuredPolyline(line), half_width_m, box_around(line, half_width_m)});
}

bool TakenSpace::contains(const Point& point) const {
  return std::ranges::any_of(strips_, [&](const Strip& strip) {
    if (!strip.box.contains(point)) return false;
    const Projection foot = strip.line.project(point, strip.half_width_m);
    return foot.inside && foot.distance_m < strip.half_width_m && same_level(foot.foot, point);
  });
}

void identify_inferred(std::uint64_t frame, std::int64_t stamp_ns, const LaneConfig& config,
                       std::vector<InferredBoundary>& inferred, std::vector<KnownInferred>& known,
                       ElementId& next_id) {
  struct Match {
    std::size_t covered, inferred, known;
  };
  std::vector<Match> matches;
  std::vector<Box> boxes;
  boxes.reserve(inferred.size());
  for (const InferredBoundary& one : inferred) boxes.push_back(box_around(one.marking.points));
  for (std::size_t k = 0; k < known.size(); ++k) {
    const MeasuredPolyline line(known[k].points);
    const Box near = box_around(known[k].points, kSame_m);
    for (std::size_t i = 0; i < inferred.size(); ++i) {
      if (!near.intersects(boxes[i])) continue;
      const Polyline& points = inferred[i].marking.points;
      const std::size_t covered = points_beside(points, line, kSame_m);
      if (2 * covered >= std::min(points.size(), known[k].points.size())) matches.push_back({covered, i, k});
    }
  }
  std::ranges::stable_sort(matches, std::greater{}, &Match::covered);
  const auto recognise = [&](Marking& marking, KnownInferred& same) {
    marking.id = same.id;
    marking.first_seen_ns = same.first_seen_ns;
    same.points = marking.points;
    same.last_frame = frame;
  };
  for (const auto& [covered, i, k] : matches)
    if (inferred[i].marking.id == kNoElement && known[k].last_frame != frame)
      recognise(inferred[i].marking, known[k]);
  for (InferredBoundary& one : inferred) {
    if (one.marking.id != kNoElement) continue;
    known.push_back({.id = next_id++, .first_seen_ns = stamp_ns});
    recognise(one.marking, known.back());
  }
  std::erase_if(known, [&](const KnownInferred& one) {
    return one.last_frame + static_cast<std::uint64_t>(config.id_memory_frames) < frame;
  });
}

void add_inferred(std::vector<InferredBoundary> inferred, std::vector<LaneBoundary>& boundaries,
                  std::vector<MeasuredPolyline>& measured, std::vector<Lane>& lanes) {
  const Occupied nothing;
  std::vector<LaneBoundary> added;
  for (InferredBoundary& one : inferred) {
    added.push_back({.marking = one.marking, .members = {one.marking.id}, .two_way = one.two_way});
    const MeasuredPolyline line(one.marking.points);
    const LaneBorder border(added.back(), line, false, nothing);
    const auto other = [&](const InferredBoundary::Beside& lane) {
      return LaneBorder(boundaries[lane.boundary], measured[lane.boundary], lane.reversed, nothing);
    };
    const auto add_lane = [&](Lane lane) {
      lane.section = one.section;
      lane.inferred_ranges = {{0.0, length(lane.centerline)}};
      lanes.push_back(std::move(lane));
    };
    const std::vector<double> arcs_m = arc_lengths(one.marking.points);
    for (std::size_t i = 0; i < arcs_m.size(); ++i) {
      if (one.on_left) one.on_left->sections[i].right_arc_m = arcs_m[i];
      if (one.on_right) one.on_right->sections[i].left_arc_m = arcs_m[i];
    }
    if (one.on_left) add_lane(make_lane(one.on_left->sections, other(*one.on_left), border));
    if (one.on_right) add_lane(make_lane(one.on_right->sections, border, other(*one.on_right)));
  }
  for (LaneBoundary& boundary : added) {
    const auto at = std::ranges::lower_bound(boundaries, boundary.marking.id, {}, id_of);
    measured.emplace(measured.begin() + (at - boundaries.begin()), boundary.marking.points);
    boundaries.insert(at, std::move(boundary));
  }
}

}  // namespace laneloom
