#include "mapping/lanes/gores.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace laneloom::lanes {
namespace {

constexpr double kMeeting_m = 1.0;           // borders that are nearer at their end meet there
constexpr double kGrowthFrom_m = 15.0;       // at the end; over it the growth of the width is measured
constexpr double kMinEarlyGrowth = 0.4;      // share on its nearer half; with less, a lane opens there
constexpr double kFarthestMeeting_m = 60.0;  // from the end to where borders that converge would meet
constexpr double kMinEntry_m = 1.5;          // width; nobody turns across dashes into less

/// Whether the borders meet at the first of these places, or not far before it.
template <class Iterator>
bool begins_at_meeting(Iterator begin, Iterator end) {
  const PlaceBetween& first = *begin;
  if (first.width_m < kMeeting_m) return true;
  const auto distance_m = [&](const PlaceBetween& place) { return std::abs(place.along_m - first.along_m); };
  const auto beyond =
      std::find_if(begin, end, [&](const PlaceBetween& p) { return distance_m(p) > kGrowthFrom_m; });
  const PlaceBetween& last = *std::prev(beyond);
  const PlaceBetween& middle = *(begin + (beyond - begin) / 2);
  const double growth_m = last.width_m - first.width_m;
  if (middle.width_m - first.width_m < kMinEarlyGrowth * growth_m) return false;
  return first.width_m * distance_m(last) < kFarthestMeeting_m * growth_m;
}

/// The number of places from the first on that lie in a gore.
template <class Iterator>
std::size_t from_meeting(Iterator begin, Iterator end) {
  if (begin == end || !begins_at_meeting(begin, end)) return 0;
  const auto entry = std::find_if(begin, end, [](const PlaceBetween& place) {
    return place.may_be_crossed && place.width_m > kMinEntry_m;
  });
  return static_cast<std::size_t>(entry - begin);
}

}  // namespace

GorePlaces in_gore(std::span<const PlaceBetween> places) {
  return {.up_to = from_meeting(places.begin(), places.end()),
          .from = places.size() - from_meeting(places.rbegin(), places.rend())};
}

}  // namespace laneloom::lanes
