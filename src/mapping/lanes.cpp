#include "mapping/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <tuple>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr std::size_t kMaxBetween = 1;         // boundaries: (b_i, b_i+1) and (b_i, b_i+2) of the paper
constexpr double kMinBetween = 0.15;           // of the stretch; a shorter boundary only touches it
constexpr double kMinKerbLaneLength_m = 10.0;  // a shorter widening is where a road splits or ends

/// A sample on the right boundary with its foot on the left one.
struct CrossSection {
  double left_arc_m = 0.0;
  double right_arc_m = 0.0;
  double width_m = 0.0;
  bool wide = false;  ///< as only a kerb lane may be
  Point left = Point::Zero();
  Point right = Point::Zero();
  bool valid = false;
};

/// Which stretches of a boundary's one side belong to a lane already.
using Occupied = std::vector<Range>;

bool contains(const std::vector<Range>& ranges, double arc_m) {
  return std::ranges::any_of(ranges, [&](const Range& r) { return r.from_m < arc_m && arc_m < r.to_m; });
}

Occupied joined(Occupied a, const Occupied& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Two boundaries that may bound a lane.
struct Pair {
  std::size_t left, right;
  bool adjacent;  ///< no other boundary between them
  std::uint32_t section;
};

/// How many boundaries lie between `left` and one on its right.
struct Between {
  std::size_t all = 0;
  std::size_t lasting = 0;  ///< those that are beside both over much of the stretch
};

Between between(const SectionGraph& graph, std::size_t left, const SideBySide& right) {
  Between count;
  for (const SideBySide& middle : graph.right_of[left]) {
    if (count.lasting > kMaxBetween) break;
    const auto& beyond = graph.right_of[middle.right];
    const auto found = std::ranges::find(beyond, right.right, &SideBySide::right);
    if (found == beyond.end()) continue;
    ++count.all;
    if (std::min(middle.length_m, found->length_m) >= kMinBetween * right.length_m) ++count.lasting;
  }
  return count;
}

/// Neighbouring boundaries first.
std::vector<Pair> pairs(const SectionGraph& graph) {
  std::array<std::vector<Pair>, kMaxBetween + 1> by_count;
  for (std::uint32_t section = 0; section < graph.sections.size(); ++section) {
    for (const std::size_t left : graph.sections[section].boundaries) {
      for (const SideBySide& beside : graph.right_of[left]) {
        const auto [all, lasting] = between(graph, left, beside);
        if (lasting > kMaxBetween) continue;
        by_count[std::min(all, kMaxBetween)].push_back({left, beside.right, all == 0, section});
      }
    }
  }
  std::vector<Pair> result;
  for (const auto& group : by_count) result.insert(result.end(), group.begin(), group.end());
  return result;
}

std::vector<CrossSection> cross_sections(const MeasuredPolyline& left, const MeasuredPolyline& right,
                                         const Occupied& left_used, const Occupied& right_used,
                                         double max_width_m, const LaneConfig& config) {
  std::vector<CrossSection> sections;
  const auto steps = static_cast<int>(std::max(1.0, std::ceil(right.length() / config.step_m)));
  for (int i = 0; i <= steps; ++i) {
    const double arc_m = right.length() * i / steps;
    const Point point = right.at(arc_m);
    const Projection foot = left.project(point);
    const bool free = !contains(left_used, foot.arc_m) && !contains(right_used, arc_m);
    const bool width_ok = foot.distance_m >= config.min_width_m && foot.distance_m <= max_width_m;
    sections.push_back({.left_arc_m = foot.arc_m,
                        .right_arc_m = arc_m,
                        .width_m = foot.distance_m,
                        .wide = foot.distance_m > config.max_width_m,
                        .left = foot.foot,
                        .right = point,
                        .valid = free && width_ok && foot.inside && foot.lateral_m < 0.0});
  }
  return sections;
}

/// The end of the longest run from `begin` in which the width varies little and the left boundary is
/// followed.
std::size_t run_end(const std::vector<CrossSection>& sections, std::size_t begin, const LaneConfig& config) {
  double narrowest = std::numeric_limits<double>::infinity(), widest = 0.0;
  std::size_t end = begin;
  while (end < sections.size() && sections[end].valid) {
    if (end > begin && sections[end].left_arc_m < sections[end - 1].left_arc_m) break;
    if (sections[end].wide != sections[begin].wide) break;
    narrowest = std::min(narrowest, sections[end].width_m);
    widest = std::max(widest, sections[end].width_m);
    if (widest - narrowest > config.max_width_variation_m) break;
    ++end;
  }
  return end;
}

/// The last range grows by the stretch, if that follows it.
void append(std::vector<Range>& ranges, const Range& stretch) {
  if (!ranges.empty() && ranges.back().to_m == stretch.from_m) {
    ranges.back().to_m = stretch.to_m;
  } else {
    ranges.push_back(stretch);
  }
}

/// How sure a lane is that lies between two markings.
void set_trust(const Marking& left, const Marking& right, Lane& lane) {
  const bool tentative = left.status == ElementStatus::tentative || right.status == ElementStatus::tentative;
  lane.status = tentative ? ElementStatus::tentative : ElementStatus::confirmed;
  lane.existence_probability = std::min(left.existence_probability, right.existence_probability);
}

Lane make_lane(std::span<const CrossSection> sections, const LaneBoundary& left, const LaneBoundary& right,
               const LaneConfig& config) {
  Lane lane{.left_boundary = left.marking.id, .right_boundary = right.marking.id};
  lane.left_range = {sections.front().left_arc_m, sections.back().left_arc_m};
  lane.right_range = {sections.front().right_arc_m, sections.back().right_arc_m};
  set_trust(left.marking, right.marking, lane);
  // Sides and centerline all go through the cross-sections, so that the one is left of the other wherever the
  // boundaries' own vertices are.
  double width_sum_m = 0.0, arc_m = 0.0;
  const auto every = static_cast<std::size_t>(std::max(1.0, config.centerline_step_m / config.step_m));
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const CrossSection& section = sections[i];
    width_sum_m += section.width_m;
    if (i % every != 0 && i + 1 != sections.size()) continue;
    const Point center = 0.5 * (section.left + section.right);
    const double from_m = arc_m;
    if (!lane.centerline.empty()) arc_m += (center - lane.centerline.back()).head<2>().norm();
    if (contains(left.bridged, section.left_arc_m) || contains(right.bridged, section.right_arc_m))
      append(lane.inferred_ranges, {from_m, arc_m});
    lane.left.push_back(section.left);
    lane.right.push_back(section.right);
    lane.centerline.push_back(center);
  }
  lane.left = MeasuredPolyline(lane.left).points();
  lane.width_m = width_sum_m / static_cast<double>(sections.size());
  std::erase_if(lane.inferred_ranges, [](const Range& range) { return range.length() <= 0.0; });
  return lane;
}

/// How many points of `line` lie within half a lane of `other`.
std::size_t points_beside(const Polyline& line, const MeasuredPolyline& other, double max_distance_m) {
  return static_cast<std::size_t>(std::ranges::count_if(line, [&](const Point& point) {
    const Projection foot = other.project(point, max_distance_m);
    return foot.inside && foot.distance_m < max_distance_m;
  }));
}

/// Whether two lines run the same way in the middle of the first.
bool same_way(const Polyline& line, const Polyline& other) {
  const MeasuredPolyline a(line), b(other);
  const double middle_m = 0.5 * a.length();
  return a.direction(middle_m).dot(b.direction(b.project(a.at(middle_m)).arc_m)) >= 0.0;
}

std::pair<ElementId, ElementId> boundary_pair(const Lane& lane) {
  return std::minmax(lane.left_boundary, lane.right_boundary);
}

double common_length(const Range& a, const Range& b) {
  return std::min(a.to_m, b.to_m) - std::max(a.from_m, b.from_m);
}

}  // namespace

std::vector<Lane> generate_lanes(const SectionGraph& graph, const std::vector<LaneBoundary>& boundaries,
                                 const std::vector<MeasuredPolyline>& measured, const LaneConfig& config) {
  std::vector<Lane> lanes;
  std::vector<Occupied> used_right_side(boundaries.size()), used_left_side(boundaries.size());
  const auto is_edge = [&](std::size_t i) { return boundaries[i].marking.type == MarkingType::roadedge; };
  const auto pair_lanes = [&](const Pair& pair, const Occupied& left_used, const Occupied& right_used) {
    const auto& [left, right, adjacent, section] = pair;
    // Between two edges so far apart, there rather is a verge.
    const bool kerb = adjacent && is_edge(left) != is_edge(right);
    const auto sections = cross_sections(measured[left], measured[right], left_used, right_used,
                                         kerb ? config.max_kerb_width_m : config.max_width_m, config);
    for (std::size_t begin = 0; begin < sections.size();) {
      const std::size_t end = std::max(run_end(sections, begin, config), begin + 1);
      const double min_length_m = sections[begin].wide ? kMinKerbLaneLength_m : config.min_length_m;
      if (sections[end - 1].left_arc_m - sections[begin].left_arc_m >= min_length_m) {
        Lane lane = make_lane(std::span(sections).subspan(begin, end - begin), boundaries[left],
                              boundaries[right], config);
        lane.section = section;
        used_right_side[left].push_back(lane.left_range);
        used_left_side[right].push_back(lane.right_range);
        lanes.push_back(std::move(lane));
      }
      begin = end;
    }
  };
  std::vector<Pair> between_edges;
  for (const Pair& pair : pairs(graph)) {
    if (is_edge(pair.left) && is_edge(pair.right)) {
      between_edges.push_back(pair);
    } else {
      pair_lanes(pair, used_right_side[pair.left], used_left_side[pair.right]);
    }
  }
  // What lies beyond the edge of a road with lanes is a verge, a pavement or a cycle track.
  const std::vector<Occupied> road_on_right = used_right_side, road_on_left = used_left_side;
  for (const Pair& pair : between_edges) {
    pair_lanes(pair, joined(used_right_side[pair.left], road_on_left[pair.left]),
               joined(used_left_side[pair.right], road_on_right[pair.right]));
  }
  return lanes;
}

void identify_lanes(std::uint64_t frame, const LaneConfig& config, std::vector<Lane>& lanes,
                    std::vector<KnownLane>& known, ElementId& next_id) {
  struct Match {
    bool other_boundaries;
    std::size_t missing;  ///< how little of the lane is covered, for sorting
    std::size_t lane, known;
  };
  std::vector<Match> matches;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const MeasuredPolyline centerline(known[k].centerline);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      const std::size_t covered = points_beside(lanes[i].centerline, centerline, 0.5 * config.min_width_m);
      if (covered == 0) continue;
      const bool other = boundary_pair(lanes[i]) != std::pair(known[k].boundary_a, known[k].boundary_b);
      matches.push_back({other, std::numeric_limits<std::size_t>::max() - covered, i, k});
    }
  }
  std::ranges::stable_sort(matches, {},
                           [](const Match& m) { return std::tuple(m.other_boundaries, m.missing); });

  std::vector<bool> taken(known.size(), false);
  std::map<ElementId, double> direction_log_odds;
  for (const auto& [other_boundaries, missing, i, k] : matches) {
    if (taken[k] || lanes[i].id != kNoElement) continue;
    taken[k] = true;
    lanes[i].id = known[k].id;
    const double sense = same_way(lanes[i].centerline, known[k].centerline) ? 1.0 : -1.0;
    direction_log_odds[known[k].id] = sense * known[k].direction_log_odds;
  }
  std::erase_if(known, [&](const KnownLane& lane) {
    const bool expired = lane.last_frame + static_cast<std::uint64_t>(config.id_memory_frames) < frame;
    return expired || std::ranges::any_of(lanes, [&](const Lane& l) { return l.id == lane.id; });
  });
  for (Lane& lane : lanes) {
    if (lane.id == kNoElement) lane.id = next_id++;
    const auto [a, b] = boundary_pair(lane);
    known.push_back({lane.id, a, b, lane.centerline, frame, direction_log_odds[lane.id]});
  }
  std::ranges::sort(lanes, {}, &Lane::id);
}

void find_neighbours(std::vector<Lane>& lanes) {
  for (Lane& lane : lanes) {
    double longest_left_m = 0.0, longest_right_m = 0.0;
    for (const Lane& other : lanes) {
      if (other.right_boundary == lane.left_boundary) {
        const double common_m = common_length(other.right_range, lane.left_range);
        if (common_m > longest_left_m) lane.left_neighbour = other.id, longest_left_m = common_m;
      }
      if (other.left_boundary == lane.right_boundary) {
        const double common_m = common_length(other.left_range, lane.right_range);
        if (common_m > longest_right_m) lane.right_neighbour = other.id, longest_right_m = common_m;
      }
    }
  }
}

}  // namespace laneloom
