#include "mapping/topology/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/smooth_step.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::topology {
namespace {

constexpr double kMaxShift_m = 1.2;   // of a lane's end, to the point where lanes meet
constexpr double kMostAside = 0.45;   // share of a lane's width, from its middle to that point
constexpr double kTouching_m = 0.01;  // lanes that are nearer need no path
constexpr double kMinAhead = 0.5;     // cosine between a lane's end and the way to the next lane
constexpr double kDrivable = 0.94;    // likewise, of a way that a vehicle drives where the next lane runs on
constexpr double kGoesOn = 0.87;      // cosine between the directions of two lanes of which one runs on

/// The end of a lane, by the lane's id.
using LaneEnd = std::pair<ElementId, End>;

/// How far a place lies on the left of the middle between two borders, as a share of their distance.
double aside(const Point& left, const Point& right, const Point& place) {
  const Eigen::Vector2d across = (left - right).head<2>(), off = (place - 0.5 * (left + right)).head<2>();
  return off.dot(across) / across.squaredNorm();
}

/// Whether the centerline of a lane may end at a place: it stays in the lane.
bool may_end_at(const Lane& lane, End end, const Point& place) {
  return (place - end_point(lane.centerline, end)).norm() <= kMaxShift_m &&
         std::abs(aside(end_point(lane.left, end), end_point(lane.right, end), place)) <= kMostAside;
}

/// Ends of lanes that meet in one point.
struct Node {
  std::vector<LaneEnd> ends;
  Point place = Point::Zero();  ///< the mean of the ends
};

/// The points where lanes meet.
class Nodes {
 public:
  explicit Nodes(RoadGraph& road) {
    for (Lane& lane : road.lanes) lanes_.emplace(lane.id, &lane);
  }

  Lane& lane(ElementId id) const { return *lanes_.at(id); }

  /// Lets two ends meet, with those that meet either of them already, if none of them has to move far.
  void join(const LaneEnd& a, const LaneEnd& b) {
    const std::size_t to = node_of(a), from = node_of(b);
    if (to == from) return;
    Node both{nodes_[to].ends};
    both.ends.insert(both.ends.end(), nodes_[from].ends.begin(), nodes_[from].ends.end());
    for (const LaneEnd& end : both.ends) both.place += place_of(end) / static_cast<double>(both.ends.size());
    const bool near = std::ranges::all_of(
        both.ends, [&](const LaneEnd& end) { return may_end_at(lane(end.first), end.second, both.place); });
    if (!near) return;
    for (const LaneEnd& end : nodes_[from].ends) index_[end] = to;
    nodes_[to] = std::move(both);
    nodes_[from].ends.clear();
  }

  /// The shift of each end that meets others.
  std::map<LaneEnd, Point> shifts() const {
    std::map<LaneEnd, Point> shifts;
    for (const Node& node : nodes_)
      for (const LaneEnd& end : node.ends) shifts.emplace(end, node.place - place_of(end));
    return shifts;
  }

 private:
  Point place_of(const LaneEnd& end) const { return end_point(lane(end.first).centerline, end.second); }
  std::size_t node_of(const LaneEnd& end) {
    const auto [found, is_new] = index_.emplace(end, nodes_.size());
    if (is_new) nodes_.push_back({{end}, place_of(end)});
    return found->second;
  }

  std::map<ElementId, Lane*> lanes_;
  std::map<LaneEnd, std::size_t> index_;
  std::vector<Node> nodes_;
};

/// Shifts both ends of a line. What lies between follows, less and less with the distance.
void bend(Polyline& line, const Point& front_shift, const Point& back_shift) {
  const std::vector<double> arcs_m = arc_lengths(line);
  const double length_m = arcs_m.back();
  const auto weight = [&](double distance_m, const Point& shift) {
    return geometry::faded(distance_m, shift.norm(), length_m);
  };
  for (std::size_t i = 0; i < line.size(); ++i)
    line[i] +=
        weight(arcs_m[i], front_shift) * front_shift + weight(length_m - arcs_m[i], back_shift) * back_shift;
}

/// Takes arc lengths of a line to those of the same places after it was bent.
class ArcsAfter {
 public:
  ArcsAfter(std::vector<double> before_m, std::vector<double> after_m)
      : before_m_(std::move(before_m)), after_m_(std::move(after_m)) {}

  void take(Stretch& stretch) const { stretch = {at(stretch.from_m), at(stretch.to_m)}; }
  void take(std::vector<Stretch>& stretches) const {
    for (Stretch& stretch : stretches) take(stretch);
  }

 private:
  double at(double arc_m) const {
    const auto next = std::ranges::upper_bound(before_m_, arc_m);
    if (next == before_m_.begin()) return after_m_.front();
    if (next == before_m_.end()) return after_m_.back();
    const auto i = static_cast<std::size_t>(next - before_m_.begin());
    const double share = (arc_m - before_m_[i - 1]) / (before_m_[i] - before_m_[i - 1]);
    return after_m_[i - 1] + share * (after_m_[i] - after_m_[i - 1]);
  }

  std::vector<double> before_m_, after_m_;
};

/// Moves a centerline back into its lane: a lane may be narrower than at the end that was shifted. The sides
/// of a lane without repeated points have the cross-sections of its centerline.
void keep_inside(Lane& lane) {
  if (lane.left.size() != lane.centerline.size() || lane.right.size() != lane.centerline.size()) return;
  for (std::size_t i = 0; i < lane.centerline.size(); ++i) {
    const double share = aside(lane.left[i], lane.right[i], lane.centerline[i]);
    lane.centerline[i] +=
        (std::clamp(share, -kMostAside, kMostAside) - share) * (lane.left[i] - lane.right[i]);
  }
}

/// Shifts both ends of a lane's centerline, and takes its stretches along.
void bend(Lane& lane, const Point& front_shift, const Point& back_shift) {
  if (front_shift.isZero(0.0) && back_shift.isZero(0.0)) return;
  std::vector<double> before_m = arc_lengths(lane.centerline);
  bend(lane.centerline, front_shift, back_shift);
  keep_inside(lane);
  const ArcsAfter arcs(std::move(before_m), arc_lengths(lane.centerline));
  arcs.take(lane.inferred_ranges);
  for (const Side side : kSides)
    for (Border& border : lane.borders(side)) arcs.take(border.range);
  for (auto* neighbours : {&lane.left_neighbours, &lane.right_neighbours}) {
    for (Neighbour& neighbour : *neighbours) {
      arcs.take(neighbour.range);
      arcs.take(neighbour.crossable);
    }
  }
}

/// The cosine between the end of a lane and the way from there to the next one.
double ahead(const Lane& from, const Lane& to) {
  const Eigen::Vector2d gap = lanes::gap_between(from, to);
  return gap.norm() > 1e-6 ? gap.normalized().dot(lanes::leaving(from)) : 1.0;
}

}  // namespace

void meet_at_joints(RoadGraph& road) {
  Nodes nodes(road);
  std::vector<std::pair<double, const Linkage*>> nearest;
  for (const Linkage& linkage : road.linkages)
    if (linkage.path.empty())
      nearest.emplace_back(lanes::gap_between(nodes.lane(linkage.from), nodes.lane(linkage.to)).norm(),
                           &linkage);
  std::ranges::stable_sort(nearest, {}, [](const auto& one) { return one.first; });
  for (const auto& [gap_m, linkage] : nearest)
    nodes.join({linkage->from, End::back}, {linkage->to, End::front});

  const std::map<LaneEnd, Point> shifts = nodes.shifts();
  const auto shift_of = [&](ElementId lane, End end) -> Point {
    const auto found = shifts.find({lane, end});
    return found == shifts.end() ? Point::Zero() : found->second;
  };
  for (Lane& lane : road.lanes) bend(lane, shift_of(lane.id, End::front), shift_of(lane.id, End::back));
  for (Linkage& linkage : road.linkages) {
    if (!linkage.path.empty()) {
      bend(linkage.path, shift_of(linkage.from, End::back), shift_of(linkage.to, End::front));
      if (length(linkage.path) < kTouching_m) linkage.path.clear();
    } else if (lanes::gap_between(nodes.lane(linkage.from), nodes.lane(linkage.to)).norm() > kTouching_m) {
      linkage.path = lanes::path_between(nodes.lane(linkage.from), nodes.lane(linkage.to));
    }
  }
  std::erase_if(road.linkages, [&](const Linkage& linkage) {
    return ahead(nodes.lane(linkage.from), nodes.lane(linkage.to)) < kMinAhead;
  });
  for (Linkage& linkage : road.linkages) {
    const Lane &from = nodes.lane(linkage.from), &to = nodes.lane(linkage.to);
    const double drivable = std::min((ahead(from, to) - kMinAhead) / (kDrivable - kMinAhead), 1.0);
    if (lanes::leaving(from).dot(lanes::entering(to)) > kGoesOn) linkage.probability *= drivable;
  }
}

}  // namespace laneloom::topology
