#include "mapping/lanes/gores.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "mapping/geometry/levels.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kMeeting_m = 1.0;       // borders that are nearer at their end meet there
constexpr double kGrowthFrom_m = 15.0;   // at the end of a run; over it the growth of the width is measured
constexpr double kMinEarlyGrowth = 0.4;  // share on its nearer half; with less, a lane opens there
constexpr double kMaxAhead_m = 60.0;     // from the end to where borders that converge would meet
constexpr double kMinEntry_m = 1.5;      // width; nobody turns across dashes into less
constexpr double kStyleReach_m = 5.0;    // either way; shorter patches of another style are noise

bool may_be_crossed(const LaneBorder& border, double arc_m) {
  if (border.marking().type == MarkingType::roadedge) return false;
  const Stretch around = border.own({arc_m - kStyleReach_m, arc_m + kStyleReach_m});
  return markings::dashed_excess_m(border.marking(), around) >= 0.0;
}

/// Whether the borders meet at the first of these cross-sections, or not far before it.
template <class Iterator>
bool begins_at_meeting(Iterator begin, Iterator end) {
  const CrossSection& first = *begin;
  if (first.width_m < kMeeting_m) return true;
  const auto distance_m = [&](const CrossSection& section) {
    return std::abs(section.right_arc_m - first.right_arc_m);
  };
  const auto beyond =
      std::find_if(begin, end, [&](const CrossSection& s) { return distance_m(s) > kGrowthFrom_m; });
  const CrossSection& last = *std::prev(beyond);
  const CrossSection& middle = *(begin + (beyond - begin) / 2);
  const double growth_m = last.width_m - first.width_m;
  if (middle.width_m - first.width_m < kMinEarlyGrowth * growth_m) return false;
  return first.width_m * distance_m(last) < kMaxAhead_m * growth_m;
}

template <class Iterator>
void remove_from_meeting(const LaneBorder& left, const LaneBorder& right, Iterator begin, Iterator end) {
  if (begin == end || !begin->valid || !begins_at_meeting(begin, end)) return;
  for (; begin != end; ++begin) {
    CrossSection& section = *begin;
    const bool open = may_be_crossed(left, section.left_arc_m) || may_be_crossed(right, section.right_arc_m);
    if (open && section.width_m > kMinEntry_m) return;
    section.valid = false;
  }
}

bool is_driven_in(std::span<const CrossSection> run, const Point& vehicle) {
  return std::ranges::any_of(run, [&](const CrossSection& section) {
    const Point middle = section.middle();
    return (middle - vehicle).head<2>().norm() < 0.5 * section.width_m &&
           geometry::same_level(middle, vehicle);
  });
}

}  // namespace

void remove_gores(const LaneBorder& left, const LaneBorder& right, const Point& vehicle,
                  std::vector<CrossSection>& sections) {
  for (auto begin = sections.begin(); begin != sections.end();) {
    begin = std::find_if(begin, sections.end(), [](const CrossSection& s) { return s.valid; });
    const auto end = std::find_if(begin, sections.end(), [](const CrossSection& s) { return !s.valid; });
    const std::span<CrossSection> run(begin, end);
    if (!is_driven_in(run, vehicle)) {
      remove_from_meeting(left, right, run.begin(), run.end());
      remove_from_meeting(left, right, run.rbegin(), run.rend());
    }
    begin = end;
  }
}

}  // namespace laneloom::lanes
