#include "mapping/lanes/continued_edges.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"

namespace laneloom::lanes {
namespace {

constexpr std::array kBehind_m{0.0, 3.0, 6.0, 9.0, 12.0};  // from an edge's end, where the road is measured
constexpr double kSteady_m = 0.6;                          // variation of its width there
constexpr double kMaxContinued_m = 30.0;                   // greatest length of a continuation
constexpr double kBareBeyond_m = 0.5;                      // behind either edge, where nothing else may lie
constexpr double kBesideEnd_m = 3.0;   // beside its end, the edge itself is not in the way
constexpr double kSeparate_m = 2.0;    // between two continuations
constexpr double kHeading_m = 3.0;     // either way, for the direction of the other edge
constexpr double kMaxBend_deg = 10.0;  // of the other edge from chord to chord

/// The other edge where an edge ends.
struct Across {
  std::size_t edge = 0;    ///< its index
  double arc_m = 0.0;      ///< on the other edge
  double sense = 1.0;      ///< in which it goes on: 1 as it runs, -1 against
  double lateral_m = 0.0;  ///< of the end; left of the other edge is positive
  double height_m = 0.0;   ///< of the end above the other edge
};

/// Continues the edges of one map.
class EdgeContinuation {
 public:
  EdgeContinuation(const boundaries::Boundaries& boundaries, const geometry::MapBox& box,
                   const LaneConfig& config)
      : boundaries_(boundaries), box_(box), config_(config) {}

  /// Adds the continuation of an edge beyond one of its ends, if there is one.
  void add(std::size_t edge, End end) {
    for (std::size_t other = 0; other < boundaries_.size(); ++other) {
      if (other == edge || !is_sure_edge(other)) continue;
      const auto across = measured(edge, end, other);
      if (!across) continue;
      if (auto marking = continuation(edge, end, *across)) continued_.push_back(std::move(*marking));
      return;
    }
  }

  std::vector<Marking> take() { return std::move(continued_); }

  bool is_sure_edge(std::size_t i) const { return boundaries_[i].is_edge() && boundaries_[i].is_confirmed(); }

 private:
  /// The place of `other` across from an end. Empty: no road of steady width lies between the two edges, or
  /// it is too narrow or too wide, or something lies on it.
  std::optional<Across> measured(std::size_t edge, End end, std::size_t other) const {
    const MeasuredPolyline &course = boundaries_[edge].course, &across = boundaries_[other].course;
    if (course.length() < kBehind_m.back()) return std::nullopt;
    Across first;
    double narrowest_m = 2.0 * config_.max_kerb_width_m, widest_m = 0.0;
    for (const double behind_m : kBehind_m) {
      const Point place = course.at(end == End::back ? course.length() - behind_m : behind_m);
      const Projection foot = across.project(place, 2.0 * config_.max_kerb_width_m);
      if (!foot.inside || !geometry::same_level(foot.foot, place) || !is_bare(place, foot.foot, edge, other))
        return std::nullopt;
      narrowest_m = std::min(narrowest_m, foot.distance_m);
      widest_m = std::max(widest_m, foot.distance_m);
      if (behind_m == 0.0)
        first = {.edge = other,
                 .arc_m = foot.arc_m,
                 .lateral_m = foot.lateral_m,
                 .height_m = place.z() - foot.foot.z()};
      first.sense = foot.arc_m < first.arc_m ? 1.0 : -1.0;
    }
    const bool steady = widest_m - narrowest_m <= kSteady_m && narrowest_m >= config_.min_divided_width_m;
    return steady ? std::optional(first) : std::nullopt;
  }

  std::optional<Marking> continuation(std::size_t edge, End end, const Across& across) const {
    const MeasuredPolyline& course = boundaries_[across.edge].course;
    Polyline line{end_point(boundaries_[edge].course.points(), end)};
    for (double ahead_m = config_.step_m; ahead_m <= kMaxContinued_m; ahead_m += config_.step_m) {
      const double arc_m = across.arc_m + across.sense * ahead_m;
      if (arc_m < 0.0 || arc_m > course.length() || turns_off(course, arc_m)) break;
      const Point from = course.at(arc_m);
      const Eigen::Vector2d along = course.chord(arc_m - kHeading_m, arc_m + kHeading_m);
      Point place = geometry::beside(from, along, across.lateral_m);
      place.z() += across.height_m;
      const std::size_t itself = ahead_m < kBesideEnd_m ? edge : across.edge;
      if (!box_.shows(place) || !is_bare(place, from, itself, across.edge) || is_continued(place)) break;
      line.push_back(place);
    }
    if (length(line) < kMinInferredLength_m) return std::nullopt;
    Marking marking = inferred_marking(line);
    marking.type = MarkingType::roadedge;
    return marking;
  }

  /// Whether another edge was continued to this place already, from the other side of a gap.
  bool is_continued(const Point& place) const {
    return std::ranges::any_of(continued_, [&](const Marking& marking) {
      return MeasuredPolyline(marking.points).project(place).distance_m < kSeparate_m;
    });
  }

  static bool turns_off(const MeasuredPolyline& course, double arc_m) {
    const Eigen::Vector2d before = course.chord(arc_m - kHeading_m, arc_m);
    const Eigen::Vector2d behind = course.chord(arc_m, arc_m + kHeading_m);
    const bool at_end = before.isZero() || behind.isZero();
    return !at_end && before.dot(behind) < cos_degrees(kMaxBend_deg);
  }

  /// Whether nothing but the two edges lies between two places on them, or close behind.
  bool is_bare(const Point& a, const Point& b, std::size_t edge_a, std::size_t edge_b) const {
    const Point middle = 0.5 * (a + b);
    const double reach_m = 0.5 * (b - a).head<2>().norm() + kBareBeyond_m;
    for (std::size_t i = 0; i < boundaries_.size(); ++i) {
      if (i == edge_a || i == edge_b) continue;
      const Projection foot = boundaries_[i].course.project(middle, reach_m);
      if (foot.distance_m < reach_m && geometry::same_level(foot.foot, middle)) return false;
    }
    return true;
  }

  const boundaries::Boundaries& boundaries_;
  const geometry::MapBox& box_;
  const LaneConfig& config_;
  std::vector<Marking> continued_;
};

}  // namespace

std::vector<Marking> continued_edges(const boundaries::Boundaries& boundaries, const geometry::MapBox& box,
                                     const LaneConfig& config) {
  if (!config.unmarked_roads) return {};
  EdgeContinuation continuation(boundaries, box, config);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    if (!continuation.is_sure_edge(i)) continue;
    for (const End end : kEnds) continuation.add(i, end);
  }
  return continuation.take();
}

}  // namespace laneloom::lanes
