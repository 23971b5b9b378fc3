#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/cross_sections.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/lane_layout.hpp"

/// Boundaries that nobody saw, with the lanes beside them: ours.
namespace laneloom {

/// What is shorter is a bay, or the mouth of a street.
inline constexpr double kMinInferredLength_m = 8.0;

struct InferredBoundary {
  /// A lane beside it.
  struct Beside {
    std::size_t boundary = 0;            ///< the lane's other one
    bool reversed = false;               ///< that runs against the inferred one
    std::vector<CrossSection> sections;  ///< one at every point of the inferred one
  };
  Marking marking;
  std::optional<Beside> on_left, on_right;  ///< as it runs; one at least
  bool two_way = false;                     ///< on a road from kerb to kerb: there traffic is taken to meet
  std::uint32_t section = 0;                ///< of the road
};

/// A marking without an id.
Marking inferred_marking(const Polyline& points);

/// Around all that is so near to a line, on its level: for seeing quickly that something is not.
using Box = Eigen::AlignedBox3d;
Box box_around(const Polyline& line, double margin_m = 0.0);

/// What lanes take of the boundaries' sides, and of the road.
class TakenSpace {
 public:
  explicit TakenSpace(const std::vector<Lane>& lanes);
  /// Stretches of the boundary, as it runs itself.
  Occupied& beside(const BoundarySide& side) { return sides_[side]; }
  void add(const Polyline& line, double half_width_m);
  bool contains(const Point& point) const;

 private:
  struct Strip {
    MeasuredPolyline line;
    double half_width_m = 0.0;
    Box box;
  };
  std::map<BoundarySide, Occupied> sides_;
  std::vector<Strip> strips_;
};

/// Lanes that were found, and what is inferred beside them. The inferred boundaries are without ids, and the
/// lanes beside them are not yet among the lanes.
struct FoundLanes {
  Boundaries boundaries;
  std::vector<Lane> lanes;
  std::vector<InferredBoundary> inferred;
};

/// Adds the inferred boundaries, which have ids now, to the others, and the lanes beside them to the lanes.
LaneLayout laid_out(FoundLanes found);

}  // namespace laneloom
