#include "mapping/trails/roadside.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/geometry/levels.hpp"
#include "mapping/trails/vehicles.hpp"

namespace laneloom::trails {
namespace {

constexpr double kStanding_mps = 0.3;
constexpr double kOneVehicle_m = 2.0;      // two that stand nearer to one another are one
constexpr double kSamePlace_m = 1.0;       // no vehicle drives nearer to one that stands
constexpr std::size_t kMaxStanding = 256;  // both sides of a street, a vehicle each 0.5 m

}  // namespace

void Roadside::add(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body) {
  cyclists_.add(objects, T_map_body);
  for (const TrackedObject& object : objects.objects) {
    if (!is_sure_vehicle(object) || object.position.head<2>().norm() > kTrackerReach_m) continue;
    const Point place = T_map_body * object.position;
    const bool stands = std::abs(object.speed_mps) <= kStanding_mps;
    const double apart_m = stands ? kOneVehicle_m : kSamePlace_m;
    std::erase_if(standing_, [&](const Point& one) {
      return (one - place).head<2>().norm() < apart_m && geometry::same_level(one, place);
    });
    if (stands) standing_.push_back(place);
  }
  if (standing_.size() > kMaxStanding)
    standing_.erase(standing_.begin(), standing_.end() - static_cast<std::ptrdiff_t>(kMaxStanding));
}

void Roadside::keep_around(const Point& vehicle) {
  cyclists_.keep_around(vehicle);
  std::erase_if(standing_, [&](const Point& place) {
    return (place - vehicle).head<2>().squaredNorm() > kTrackerReach_m * kTrackerReach_m;
  });
}

}  // namespace laneloom::trails
