#include "mapping/lanes/gores.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace laneloom::lanes {
namespace {

constexpr double kMeeting_m = 1.0;       // borders that are nearer at their end meet there
constexpr double kGrowthFrom_m = 15.0;   // at the end; over it the growth of the width is measured
constexpr double kMinEarlyGrowth = 0.4;  // share on its nearer half; with less, a lane opens there
constexpr double kMaxAhead_m = 60.0;     // from the end to where borders that converge would meet
constexpr double kMinEntry_m = 1.5;      // width; nobody turns across dashes into less

/// Whether the borders meet at the first of these places, or not far before it.
bool begins_at_meeting(std::span<const PlaceBetween> places) {
  const PlaceBetween& first = places.front();
  if (first.width_m < kMeeting_m) return true;
  const auto distance_m = [&](const PlaceBetween& place) { return std::abs(place.along_m - first.along_m); };
  const auto beyond =
      std::ranges::find_if(places, [&](const PlaceBetween& p) { return distance_m(p) > kGrowthFrom_m; });
  const PlaceBetween& last = *std::prev(beyond);
  const PlaceBetween& middle = *(places.begin() + (beyond - places.begin()) / 2);
  const double growth_m = last.width_m - first.width_m;
  if (middle.width_m - first.width_m < kMinEarlyGrowth * growth_m) return false;
  return first.width_m * distance_m(last) < kMaxAhead_m * growth_m;
}

/// The number of places from the first on that lie in a gore.
std::size_t from_meeting(std::span<const PlaceBetween> places) {
  if (places.empty() || !begins_at_meeting(places)) return 0;
  const auto entry = std::ranges::find_if(
      places, [](const PlaceBetween& place) { return place.may_be_crossed && place.width_m > kMinEntry_m; });
  return static_cast<std::size_t>(entry - places.begin());
}

}  // namespace

std::vector<bool> in_gore(std::span<const PlaceBetween> places) {
  const std::vector<PlaceBetween> backwards(places.rbegin(), places.rend());
  const std::size_t opening = from_meeting(places), closing = from_meeting(backwards);
  std::vector<bool> found(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) found[i] = i < opening || places.size() - i <= closing;
  return found;
}

}  // namespace laneloom::lanes
