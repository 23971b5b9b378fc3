#include "mapping/lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "laneloom/polyline.hpp"
#include "mapping/lane_geometry.hpp"

namespace laneloom {
namespace {

constexpr std::size_t kMaxBetween = 1;         // boundaries: (b_i, b_i+1) and (b_i, b_i+2) of the paper
constexpr double kMinBetween = 0.15;           // of the stretch; a shorter boundary only touches it
constexpr double kNarrow_m = 2.5;              // narrower are lanes that are so from end to end
constexpr double kTaper_m = 0.3;               // by which what is not so grows beyond that
constexpr double kEdgeLine_m = 1.0;            // from an edge to the line that is painted along it
constexpr double kMinBesideEdge = 0.5;         // of that line
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

/// Two boundaries that may bound a lane. It runs as the one does that is not reversed.
struct Pair {
  std::size_t left, right;
  bool left_reversed, right_reversed;
  bool adjacent;  ///< no other boundary between them
  std::uint32_t section;
};

/// How many boundaries lie between one and another beside it.
struct Between {
  std::size_t all = 0;
  std::size_t lasting = 0;  ///< those that are beside both over much of the stretch
};

Between between(const SectionGraph& graph, std::size_t one, const SideBySide& other) {
  const auto& beyond = graph.beside[other.other];
  const bool one_on_left = other.opposed == other.on_left();  // of the other
  Between count;
  for (const SideBySide& middle : graph.beside[one]) {
    if (count.lasting > kMaxBetween) break;
    if (middle.on_left() != other.on_left()) continue;
    const auto found = std::ranges::find(beyond, middle.other, &SideBySide::other);
    if (found == beyond.end() || found->on_left() != one_on_left) continue;
    ++count.all;
    if (std::min(middle.length_m, found->length_m) >= kMinBetween * other.length_m) ++count.lasting;
  }
  return count;
}

/// Neighbouring boundaries first. Of two that are opposed, the lane runs as the older one.
std::vector<Pair> pairs(const SectionGraph& graph) {
  std::array<std::vector<Pair>, kMaxBetween + 1> by_count;
  for (std::uint32_t section = 0; section < graph.sections.size(); ++section) {
    for (const std::size_t one : graph.sections[section].boundaries) {
      for (const SideBySide& other : graph.beside[one]) {
        if (other.opposed ? other.other < one : other.on_left()) continue;
        const auto [all, lasting] = between(graph, one, other);
        if (lasting > kMaxBetween) continue;
        Pair pair{one, other.other, false, other.opposed, all == 0, section};
        if (other.on_left()) {
          std::swap(pair.left, pair.right);
          std::swap(pair.left_reversed, pair.right_reversed);
        }
        by_count[std::min(all, kMaxBetween)].push_back(pair);
      }
    }
  }
  std::vector<Pair> result;
  for (const auto& group : by_count) result.insert(result.end(), group.begin(), group.end());
  return result;
}

/// A boundary, as a lane beside it runs.
class Side {
 public:
  Side(const LaneBoundary& boundary, const MeasuredPolyline& measured, bool reversed,
       const Occupied& occupied)
      : boundary_(boundary), measured_(measured), reversed_(reversed), occupied_(occupied) {
    if (reversed) turned_ = MeasuredPolyline(Polyline(measured.points().rbegin(), measured.points().rend()));
  }
  const MeasuredPolyline& line() const { return reversed_ ? turned_ : measured_; }
  const Marking& marking() const { return boundary_.marking; }
  bool reversed() const { return reversed_; }
  bool is_free(double arc_m) const { return !contains(occupied_, own(arc_m)); }
  bool is_bridged(double arc_m) const { return contains(boundary_.bridged, own(arc_m)); }
  /// On the boundary as it runs itself.
  Range own(const Range& range) const {
    return reversed_ ? Range{own(range.to_m), own(range.from_m)} : range;
  }

 private:
  double own(double arc_m) const { return reversed_ ? measured_.length() - arc_m : arc_m; }

  const LaneBoundary& boundary_;
  const MeasuredPolyline& measured_;
  bool reversed_;
  MeasuredPolyline turned_;
  const Occupied& occupied_;
};

std::vector<CrossSection> cross_sections(const Side& left, const Side& right, double max_width_m,
                                         const LaneConfig& config) {
  const Polyline points = right.line().resample(config.step_m);
  std::vector<CrossSection> sections(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m =
        right.line().length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
    if (!right.is_free(arc_m)) continue;
    const Projection foot = left.line().project(points[i], max_width_m);
    if (!foot.inside || foot.distance_m < config.min_width_m || foot.lateral_m >= 0.0) continue;
    if (!left.is_free(foot.arc_m)) continue;
    sections[i] = {.left_arc_m = foot.arc_m,
                   .right_arc_m = arc_m,
                   .width_m = foot.distance_m,
                   .wide = foot.distance_m > config.max_width_m,
                   .left = foot.foot,
                   .right = points[i],
                   .valid = true};
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

/// The next run from `begin` on, which is moved behind it. Without its narrow ends where it is wider
/// elsewhere: there a lane opens or closes beside another.
std::span<const CrossSection> next_run(const std::vector<CrossSection>& sections, std::size_t& begin,
                                       const LaneConfig& config) {
  const auto is_narrow = [](const CrossSection& section) { return section.width_m < kNarrow_m; };
  const auto run_from = [&](std::size_t first) {
    return std::span(sections).subspan(first, std::max(run_end(sections, first, config), first + 1) - first);
  };
  auto run = run_from(begin);
  if (std::ranges::max_element(run, {}, &CrossSection::width_m)->width_m >= kNarrow_m + kTaper_m) {
    while (is_narrow(sections[begin])) ++begin;
    run = run_from(begin);
    begin += run.size();
    while (is_narrow(run.back())) run = run.first(run.size() - 1);
    return run;
  }
  begin += run.size();
  return run;
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

Lane make_lane(std::span<const CrossSection> sections, const Side& left, const Side& right) {
  Lane lane{.left_boundary = left.marking().id,
            .right_boundary = right.marking().id,
            .left_range = left.own({sections.front().left_arc_m, sections.back().left_arc_m}),
            .right_range = right.own({sections.front().right_arc_m, sections.back().right_arc_m}),
            .left_reversed = left.reversed(),
            .right_reversed = right.reversed()};
  set_trust(left.marking(), right.marking(), lane);
  // Sides and centerline all go through the cross-sections, so that the one is left of the other wherever the
  // boundaries' own vertices are.
  for (Polyline* line : {&lane.left, &lane.right, &lane.centerline}) line->reserve(sections.size());
  double width_sum_m = 0.0, arc_m = 0.0;
  for (const CrossSection& section : sections) {
    width_sum_m += section.width_m;
    const Point center = 0.5 * (section.left + section.right);
    const double from_m = arc_m;
    if (!lane.centerline.empty()) arc_m += (center - lane.centerline.back()).head<2>().norm();
    if (left.is_bridged(section.left_arc_m) || right.is_bridged(section.right_arc_m))
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

double common_length(const Range& a, const Range& b) {
  return std::min(a.to_m, b.to_m) - std::max(a.from_m, b.from_m);
}

}  // namespace

std::vector<Lane> generate_lanes(const SectionGraph& graph, const std::vector<LaneBoundary>& boundaries,
                                 const std::vector<MeasuredPolyline>& measured, const LaneConfig& config) {
  std::vector<Lane> lanes;
  // Per boundary: its right side, its left side.
  std::vector<std::array<Occupied, 2>> used(boundaries.size());
  const auto is_edge = [&](std::size_t i) { return boundaries[i].marking.type == MarkingType::roadedge; };
  const auto is_outermost = [&](std::size_t i, bool left) {
    return is_edge(i) || std::ranges::any_of(graph.beside[i], [&](const SideBySide& beside) {
             return is_edge(beside.other) && beside.on_left() == left &&
                    std::abs(beside.lateral_m) < kEdgeLine_m &&
                    beside.length_m >= kMinBesideEdge * measured[i].length();
           });
  };
  const auto pair_lanes = [&](const Pair& pair, const Occupied& left_used, const Occupied& right_used) {
    const Side left(boundaries[pair.left], measured[pair.left], pair.left_reversed, left_used);
    const Side right(boundaries[pair.right], measured[pair.right], pair.right_reversed, right_used);
    // Between two edges so far apart, there rather is a verge.
    const bool kerb = pair.adjacent && is_outermost(pair.left, !pair.left_reversed) !=
                                           is_outermost(pair.right, pair.right_reversed);
    const auto sections =
        cross_sections(left, right, kerb ? config.max_kerb_width_m : config.max_width_m, config);
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, config);
      const double min_length_m = run.front().wide ? kMinKerbLaneLength_m : config.min_length_m;
      if (run.back().left_arc_m - run.front().left_arc_m >= min_length_m) {
        lanes.push_back(make_lane(run, left, right));
        lanes.back().section = pair.section;
        used[pair.left][pair.left_reversed].push_back(lanes.back().left_range);
        used[pair.right][!pair.right_reversed].push_back(lanes.back().right_range);
      }
    }
  };
  std::vector<Pair> between_edges;
  for (const Pair& pair : pairs(graph)) {
    if (is_edge(pair.left) && is_edge(pair.right)) {
      between_edges.push_back(pair);
    } else {
      pair_lanes(pair, used[pair.left][pair.left_reversed], used[pair.right][!pair.right_reversed]);
    }
  }
  // What lies beyond the edge of a road with lanes is a verge, a pavement or a cycle track.
  const auto roads = used;
  for (const Pair& pair : between_edges) {
    pair_lanes(pair, joined(used[pair.left][pair.left_reversed], roads[pair.left][!pair.left_reversed]),
               joined(used[pair.right][!pair.right_reversed], roads[pair.right][pair.right_reversed]));
  }
  return lanes;
}

void find_neighbours(std::vector<Lane>& lanes) {
  for (Lane& lane : lanes) {
    const auto across = [&](const LaneSide& side) {
      ElementId neighbour = kNoElement;
      double longest_m = 0.0;
      for (const Lane& other : lanes) {
        for (const bool left : {true, false}) {
          const LaneSide beyond = lane_side(other, left);
          if (beyond.of != side.of.other()) continue;
          const double common_m = common_length(beyond.range, side.range);
          if (common_m > longest_m) neighbour = other.id, longest_m = common_m;
        }
      }
      return neighbour;
    };
    lane.left_neighbour = across(lane_side(lane, true));
    lane.right_neighbour = across(lane_side(lane, false));
  }
}

}  // namespace laneloom
