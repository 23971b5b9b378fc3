#include "mapping/lanes/neighbours.hpp"

#include <algorithm>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMinBeside_m = 1.0;  // a shorter stretch is where one lane ends and the next begins

/// Takes stretches of one side of a lane to its centerline, by scaling: both run from the lane's start to its
/// end.
class SideToCenterline {
 public:
  SideToCenterline(const LaneSide& side, double centerline_m)
      : begin_m_(side.begin_m()),
        scale_(centerline_m / (side.end_m() - side.begin_m())),
        end_m_(centerline_m) {}

  Stretch operator()(const Stretch& on_boundary) const {
    const double a = at(on_boundary.from_m), b = at(on_boundary.to_m);
    return {std::min(a, b), std::max(a, b)};
  }

 private:
  double at(double boundary_m) const { return std::clamp((boundary_m - begin_m_) * scale_, 0.0, end_m_); }

  double begin_m_, scale_, end_m_;
};

std::vector<Stretch> dashed_within(const Marking& boundary, const Stretch& stretch,
                                   const SideToCenterline& to_centerline) {
  std::vector<Stretch> dashed;
  for (const StyleRange& part : boundary.styles) {
    const Stretch range = geometry::common(part.range, stretch);
    if (part.style == MarkingStyle::dashed && range.length() > 0.0) dashed.push_back(to_centerline(range));
  }
  std::ranges::sort(dashed, {}, &Stretch::from_m);
  return dashed;
}

std::vector<Neighbour> neighbours_beyond(const Lane& lane, Side its_side, const LaneLayout& layout) {
  const LaneSide side = lane_side(lane, its_side);
  const SideToCenterline to_centerline(side, length(lane.centerline));
  std::vector<Neighbour> neighbours;
  for (const Lane& other : layout.lanes) {
    for (const Side other_side : kSides) {
      const LaneSide beyond = lane_side(other, other_side);
      const Stretch stretch = geometry::common(beyond.range, side.range);
      if (beyond.of != side.of.other() || stretch.length() < kMinBeside_m) continue;
      const Marking& boundary = layout.boundaries.of(side.of.boundary).marking;
      neighbours.push_back(
          {other.id, to_centerline(stretch), dashed_within(boundary, stretch, to_centerline)});
    }
  }
  std::ranges::sort(neighbours, {}, [](const Neighbour& neighbour) { return neighbour.range.from_m; });
  return neighbours;
}

}  // namespace

void find_neighbours(LaneLayout& layout) {
  for (Lane& lane : layout.lanes) {
    lane.left_neighbours = neighbours_beyond(lane, Side::left, layout);
    lane.right_neighbours = neighbours_beyond(lane, Side::right, layout);
  }
}

}  // namespace laneloom::lanes
