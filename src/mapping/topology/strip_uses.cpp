#include "mapping/topology/strip_uses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/reproducible.hpp"
#include "mapping/lanes/inferred_boundaries.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::topology {
namespace {

constexpr std::array kUses{Lane::Use::shoulder, Lane::Use::parking, Lane::Use::cycle};
using LogOdds = std::array<double, kUses.size()>;

// Log odds of each use of a strip. The weights were set by hand.
constexpr double kSolid = 1.5;           // a shoulder lies behind a solid line, not behind a dashed one
constexpr double kNoEdge = -4.0;         // a shoulder lies beside an edge
constexpr double kParking = -2.0;        // few strips are for parking,
constexpr double kParkedVehicle = 2.0;   // unless vehicles stand there. One may have broken down.
constexpr double kLeastParking_m = 1.7;  // a vehicle's width
constexpr double kTooNarrow = -6.0;
constexpr double kCycleBesideEdge = -1.0;  // such strips rather are shoulders,
constexpr double kDashed = 1.0;            // unless their line may be crossed
constexpr double kCyclist = 4.0;
constexpr double kMostCycle_m = 2.3;  // a cycle lane is narrower
constexpr double kTooWide = -4.0;
constexpr double kAsBefore = 1.0;  // the map before told that use
constexpr std::size_t kMostWitnesses = 3;
constexpr std::size_t kLeastRidden = 5;  // points of a trail, 1 m apart at least

/// A strip, and who stands and rides there.
class ObservedStrip {
 public:
  ObservedStrip(const Lane& strip, const boundaries::Boundaries& boundaries) : width_m_(strip.width_m) {
    space_.add(strip.centerline, 0.5 * strip.width_m);
    double dashed_m = 0.0;  // of its lines, less what of them is solid
    for (const Side side : kSides)
      for (const Border& border : strip.borders(side)) {
        const boundaries::LaneBoundary* boundary = boundaries.find(border.boundary);
        if (boundary == nullptr) continue;
        if (boundary->is_edge())
          has_edge_ = true;
        else
          dashed_m += markings::dashed_excess_m(boundary->marking, border.on_boundary);
      }
    dashed_ = std::clamp(dashed_m / std::max(length(strip.centerline), 1.0), -1.0, 1.0);
  }

  /// Log odds of each use, but for a common term.
  LogOdds uses(const trails::Roadside& roadside) const {
    return {-kSolid * dashed_ + (has_edge_ ? 0.0 : kNoEdge),
            kParking + kParkedVehicle * counted(standing(roadside)) +
                (width_m_ < kLeastParking_m ? kTooNarrow : 0.0),
            kDashed * std::max(dashed_, 0.0) + (has_edge_ ? kCycleBesideEdge : 0.0) +
                kCyclist * counted(ridden(roadside)) + (width_m_ > kMostCycle_m ? kTooWide : 0.0)};
  }

 private:
  static double counted(std::ptrdiff_t witnesses) {
    return static_cast<double>(std::min(static_cast<std::size_t>(witnesses), kMostWitnesses));
  }
  std::ptrdiff_t standing(const trails::Roadside& roadside) const {
    return std::ranges::count_if(roadside.standing(),
                                 [&](const Point& place) { return space_.contains(place); });
  }
  std::ptrdiff_t ridden(const trails::Roadside& roadside) const {
    return std::ranges::count_if(roadside.cyclists(), [&](const trails::Trail& trail) {
      const auto within =
          std::ranges::count_if(trail.points, [&](const Point& point) { return space_.contains(point); });
      return static_cast<std::size_t>(within) >= kLeastRidden;
    });
  }

  double width_m_;
  lanes::TakenSpace space_;
  bool has_edge_ = false;
  double dashed_ = 0.0;  ///< from -1, where its lines are solid, to 1
};

}  // namespace

void tell_uses(const trails::Roadside& roadside, const std::vector<Lane>& former, RoadGraph& road) {
  for (Lane& strip : road.side_strips) {
    LogOdds uses = ObservedStrip(strip, road.boundaries).uses(roadside);
    const auto before = std::ranges::find(former, strip.id, &Lane::id);
    for (std::size_t i = 0; i < kUses.size(); ++i)
      if (before != former.end() && before->use == kUses.at(i)) uses.at(i) += kAsBefore;
    const double most = std::ranges::max(uses);
    double sum = 0.0;
    for (const double use : uses) sum += geometry::reproducible::exp(use - most);
    strip.use = kUses.at(static_cast<std::size_t>(std::ranges::find(uses, most) - uses.begin()));
    strip.use_probability = 1.0 / sum;
  }
}

}  // namespace laneloom::topology
