#include "mapping/lanes/neighbours.hpp"

#include <algorithm>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom {
namespace {

constexpr double kMinBeside_m = 1.0;  // a shorter stretch is where one lane ends and the next begins

Range common(const Range& a, const Range& b) {
  return {std::max(a.from_m, b.from_m), std::min(a.to_m, b.to_m)};
}

/// Takes stretches of one side of a lane to its centerline, which runs as far in the same time.
class SideToCenterline {
 public:
  SideToCenterline(const LaneSide& side, double centerline_m)
      : begin_m_(side.begin_m()),
        scale_(centerline_m / (side.end_m() - side.begin_m())),
        end_m_(centerline_m) {}

  Range operator()(const Range& on_boundary) const {
    const double a = at(on_boundary.from_m), b = at(on_boundary.to_m);
    return {std::min(a, b), std::max(a, b)};
  }

 private:
  double at(double boundary_m) const { return std::clamp((boundary_m - begin_m_) * scale_, 0.0, end_m_); }

  double begin_m_, scale_, end_m_;
};

std::vector<Range> dashed_within(const Marking& boundary, const Range& stretch,
                                 const SideToCenterline& to_centerline) {
  std::vector<Range> dashed;
  for (const StyleRange& part : boundary.styles) {
    const Range range = common(part.range, stretch);
    if (part.style == MarkingStyle::dashed && range.length() > 0.0) dashed.push_back(to_centerline(range));
  }
  std::ranges::sort(dashed, {}, &Range::from_m);
  return dashed;
}

std::vector<Neighbour> neighbours_beyond(const Lane& lane, bool left,
                                         const std::vector<LaneBoundary>& boundaries,
                                         const std::vector<Lane>& lanes) {
  const LaneSide side = lane_side(lane, left);
  const SideToCenterline to_centerline(side, length(lane.centerline));
  std::vector<Neighbour> neighbours;
  for (const Lane& other : lanes) {
    for (const bool its_left : {true, false}) {
      const LaneSide beyond = lane_side(other, its_left);
      const Range stretch = common(beyond.range, side.range);
      if (beyond.of != side.of.other() || stretch.length() < kMinBeside_m) continue;
      const Marking& boundary = boundary_of(boundaries, side.of.boundary).marking;
      neighbours.push_back(
          {other.id, to_centerline(stretch), dashed_within(boundary, stretch, to_centerline)});
    }
  }
  std::ranges::sort(neighbours, {}, [](const Neighbour& neighbour) { return neighbour.range.from_m; });
  return neighbours;
}

}  // namespace

void find_neighbours(const std::vector<LaneBoundary>& boundaries, std::vector<Lane>& lanes) {
  for (Lane& lane : lanes) {
    lane.left_neighbours = neighbours_beyond(lane, true, boundaries, lanes);
    lane.right_neighbours = neighbours_beyond(lane, false, boundaries, lanes);
  }
}

}  // namespace laneloom
