#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/cross_sections.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/lane_layout.hpp"

/// Inferred boundaries: no detection showed them, but there is room for the lanes beside them. Ours.
namespace laneloom::lanes {

/// Least length of an inferred boundary. A shorter space is a bay, or the mouth of a street.
inline constexpr double kMinInferredLength_m = 8.0;

/// An inferred boundary, with the lanes beside it.
struct InferredBoundary {
  /// A lane beside the inferred boundary.
  struct Beside {
    std::size_t boundary = 0;            ///< index of the lane's other boundary
    bool reversed = false;               ///< the other boundary runs against the inferred one
    std::vector<CrossSection> sections;  ///< one at every point of the inferred boundary
  };
  Marking marking;
  std::optional<Beside> on_left, on_right;  ///< sides as it runs; at least one is set
  bool two_way = false;                     ///< between two kerbs: opposite directions of traffic meet here
  std::uint32_t section = 0;                ///< index of the road section
};

/// The markings of inferred boundaries.
std::vector<Marking*> markings_of(std::vector<InferredBoundary>& inferred);

/// A marking of status inferred through `points`, without an id.
Marking inferred_marking(const Polyline& points);

/// The space that lanes or other strips take: stretches along the sides of boundaries, and strips of the
/// road.
class TakenSpace {
 public:
  /// Taken stretches along one side of a boundary, as it runs itself.
  std::vector<Stretch>& beside(const BoundarySide& side) { return sides_[side]; }
  void add(const Polyline& line, double half_width_m);
  bool contains(const Point& point) const;

 private:
  /// The strip along a line, to half of its width on either side.
  struct Strip {
    MeasuredPolyline line;
    double half_width_m = 0.0;
    Box box;  ///< around the strip
  };
  std::map<BoundarySide, std::vector<Stretch>> sides_;
  std::deque<Strip> strips_;  ///< grows without copying the lines
};

/// Lanes that were found, and inferred boundaries. The inferred boundaries have no ids, and the lanes beside
/// them are not yet among the lanes.
struct FoundLanes {
  boundaries::Boundaries boundaries;
  std::vector<Lane> lanes;
  std::vector<InferredBoundary> inferred;
  std::vector<Fork> forks{};
  std::vector<DeniedStretch> denied{};  ///< where the last map had a lane
  std::vector<Lane> side_strips{};      ///< beside the lanes: shoulders, and cycle lanes
};

/// Adds the inferred boundaries to the boundaries, and the lanes beside them to the lanes. The inferred
/// boundaries must have ids by now.
LaneLayout laid_out(FoundLanes found);

}  // namespace laneloom::lanes
