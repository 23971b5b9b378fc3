#include "export/self_crossings.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {
namespace {

constexpr double kNear_m = 15.0;  // seen from above: as far as lanes reach
constexpr std::size_t kStep = 4;  // only every so many-th vertex is used

/// The arc length of the middle between the first place that is above or below another one, and the nearest
/// such other place. None: there is no such place.
std::optional<double> cut_at(const Polyline& points) {
  const std::vector<double> arcs_m = arc_lengths(points);
  for (std::size_t i = 0; i < points.size(); i += kStep)
    for (std::size_t j = i + 1; j < points.size(); j += kStep)
      if ((points[i] - points[j]).head<2>().norm() < kNear_m && !geometry::same_level(points[i], points[j]))
        return 0.5 * (arcs_m[i] + arcs_m[j]);
  return std::nullopt;
}

boundaries::LaneBoundary part_of(const boundaries::LaneBoundary& boundary, const Stretch& stretch) {
  boundaries::LaneBoundary part{.marking = markings::slice(boundary.marking, stretch),
                                .members = boundary.members};
  for (const Stretch& gap : boundary.bridged) {
    const Stretch within{std::max(gap.from_m, stretch.from_m) - stretch.from_m,
                         std::min(gap.to_m, stretch.to_m) - stretch.from_m};
    if (within.length() > 0.0) part.bridged.push_back(within);
  }
  return part;
}

}  // namespace

boundaries::Boundaries cut_self_crossings(boundaries::Boundaries all, markings::IdSource& ids) {
  std::vector<boundaries::LaneBoundary> boundaries = std::move(all).take();
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const std::optional<double> at_m = cut_at(boundaries[i].marking.points);
    if (!at_m) continue;
    const double length_m = length(boundaries[i].marking.points);
    boundaries::LaneBoundary rest = part_of(boundaries[i], {*at_m, length_m});
    boundaries[i] = part_of(boundaries[i], {0.0, *at_m});
    rest.marking.id = ids.next();
    boundaries.push_back(std::move(rest));
    --i;  // the first part may cross itself again
  }
  return boundaries;
}

}  // namespace laneloom::exports
