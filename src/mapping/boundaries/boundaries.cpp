#include <algorithm>
#include <cassert>
#include <iterator>

#include "mapping/boundaries/islands.hpp"
#include "mapping/boundaries/lane_boundaries.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/stretches.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::boundaries {
namespace {

ElementId id_of(const LaneBoundary& boundary) { return boundary.marking.id; }

void measure(LaneBoundary& boundary) {
  boundary.course = MeasuredPolyline(boundary.marking.points);
  boundary.island = boundary.is_edge() ? island_side(boundary.course) : std::nullopt;
}

}  // namespace

Boundaries::Boundaries(std::vector<LaneBoundary> boundaries) : all_(std::move(boundaries)) {
  std::ranges::for_each(all_, measure);
  std::ranges::sort(all_, {}, id_of);
}

const LaneBoundary* Boundaries::find(ElementId id) const {
  const auto found = std::ranges::lower_bound(all_, id, {}, id_of);
  return found != all_.end() && id_of(*found) == id ? &*found : nullptr;
}

std::size_t Boundaries::index_of(ElementId id) const {
  const LaneBoundary* found = find(id);
  assert(found != nullptr);
  return static_cast<std::size_t>(found - all_.data());
}

void Boundaries::reverse(std::size_t index) {
  LaneBoundary& boundary = all_[index];
  const double total_m = length(boundary.marking.points);
  markings::reverse(boundary.marking);
  geometry::reverse(boundary.bridged, total_m);
  measure(boundary);
}

void Boundaries::insert(std::vector<LaneBoundary> boundaries) {
  if (boundaries.empty()) return;
  std::ranges::for_each(boundaries, measure);
  std::ranges::move(boundaries, std::back_inserter(all_));
  std::ranges::stable_sort(all_, {}, id_of);
}

bool crosses_edge(const Polyline& path, const Boundaries& boundaries) {
  return std::ranges::any_of(boundaries, [&](const LaneBoundary& boundary) {
    return boundary.is_edge() && !boundary.is_unseen_edge() &&
           intersect(path, boundary.marking.points, geometry::kLevel_m);
  });
}

}  // namespace laneloom::boundaries
