#include "mapping/lanes/neighbours.hpp"

#include <algorithm>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMinBeside_m = 1.0;  // a shorter stretch is where one lane ends and the next begins

/// Takes stretches of a boundary to the centerline of a lane beside it, by scaling.
class SideToCenterline {
 public:
  SideToCenterline(const LaneSide& side, const Stretch& on_centerline)
      : begin_m_(side.begin_m()),
        scale_(on_centerline.length() / (side.end_m() - side.begin_m())),
        on_centerline_(on_centerline) {}

  Stretch operator()(const Stretch& on_boundary) const {
    const double a = at(on_boundary.from_m), b = at(on_boundary.to_m);
    return {std::min(a, b), std::max(a, b)};
  }

 private:
  double at(double boundary_m) const {
    return std::clamp(on_centerline_.from_m + (boundary_m - begin_m_) * scale_, on_centerline_.from_m,
                      on_centerline_.to_m);
  }

  double begin_m_, scale_;
  Stretch on_centerline_;
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

/// The lanes beyond one border of a lane.
void add_beyond(const Border& border, Side its_side, const LaneLayout& layout,
                std::vector<Neighbour>& neighbours) {
  const LaneSide side = lane_side(border, its_side);
  const SideToCenterline to_centerline(side, border.range);
  const Marking& boundary = layout.boundaries.of(border.boundary).marking;
  for (const Lane& other : layout.lanes) {
    for (const Side other_side : kSides) {
      for (const Border& facing : other.borders(other_side)) {
        const LaneSide beyond = lane_side(facing, other_side);
        const Stretch stretch = geometry::common(beyond.range, side.range);
        if (beyond.of != side.of.other() || stretch.length() < kMinBeside_m) continue;
        neighbours.push_back(
            {other.id, to_centerline(stretch), dashed_within(boundary, stretch, to_centerline)});
      }
    }
  }
}

/// Joins the stretches of one neighbour that follow one another.
std::vector<Neighbour> joined(std::vector<Neighbour> neighbours) {
  std::vector<Neighbour> result;
  for (Neighbour& next : neighbours) {
    const bool continues = !result.empty() && result.back().lane == next.lane &&
                           next.range.from_m - result.back().range.to_m < kMinBeside_m;
    if (!continues) {
      result.push_back(std::move(next));
      continue;
    }
    Neighbour& last = result.back();
    last.range.to_m = std::max(last.range.to_m, next.range.to_m);
    last.crossable.insert(last.crossable.end(), next.crossable.begin(), next.crossable.end());
  }
  return result;
}

std::vector<Neighbour> neighbours_beyond(const Lane& lane, Side side, const LaneLayout& layout) {
  std::vector<Neighbour> neighbours;
  for (const Border& border : lane.borders(side))
    if (border.boundary != kNoElement) add_beyond(border, side, layout, neighbours);
  std::ranges::stable_sort(neighbours, {}, [](const Neighbour& neighbour) { return neighbour.range.from_m; });
  return joined(std::move(neighbours));
}

}  // namespace

void find_neighbours(LaneLayout& layout) {
  for (Lane& lane : layout.lanes) {
    lane.left_neighbours = neighbours_beyond(lane, Side::left, layout);
    lane.right_neighbours = neighbours_beyond(lane, Side::right, layout);
  }
}

}  // namespace laneloom::lanes
