#include "export/driven_places.hpp"

#include <cmath>

#include "mapping/geometry/levels.hpp"

namespace laneloom::exports {
namespace {

constexpr double kCell_m = 4.0;
constexpr int kReach = static_cast<int>(DrivenPlaces::kReach_m / kCell_m);  // cells to each side

int cell(double value_m) { return static_cast<int>(std::floor(value_m / kCell_m)); }
int level(double height_m) { return static_cast<int>(std::floor(height_m / (2.0 * geometry::kLevel_m))); }

}  // namespace

void DrivenPlaces::add(const Point& vehicle, std::size_t drive) {
  const int x = cell(vehicle.x()), y = cell(vehicle.y());
  for (int i = x - kReach; i <= x + kReach; ++i)
    for (int j = y - kReach; j <= y + kReach; ++j)
      for (const int k : {level(vehicle.z() - geometry::kLevel_m), level(vehicle.z() + geometry::kLevel_m)}) {
        Passes& passes = cells_[{i, j, k}];
        if (passes.drives > 0 && passes.last == drive) continue;
        ++passes.drives;
        passes.last = drive;
      }
}

const DrivenPlaces::Passes* DrivenPlaces::find(const Point& place) const {
  const auto found = cells_.find({cell(place.x()), cell(place.y()), level(place.z())});
  return found == cells_.end() ? nullptr : &found->second;
}

int DrivenPlaces::passed(const Point& place) const {
  const Passes* passes = find(place);
  return passes == nullptr ? 0 : passes->drives;
}

bool DrivenPlaces::passed_last(const Point& place, std::size_t drive) const {
  const Passes* passes = find(place);
  return passes != nullptr && passes->last == drive;
}

}  // namespace laneloom::exports
