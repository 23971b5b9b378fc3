#include "mapping/lanes/driven_lane.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::lanes {
namespace {

constexpr double kBesideSection_m = 1.0;  // of a place from a cross-section, along the road
constexpr int kLeastPlaces = 8;
constexpr double kLeastWidth_m = 2.7, kMostWidth_m = 4.0;

/// The distance of a place from one border of a strip. Empty: it does not lie in the strip.
std::optional<double> distance_within(const Point& place, Side border, std::span<const CrossSection> strip) {
  for (const CrossSection& section : strip) {
    const bool is_left = border == Side::left;
    const Point &from = is_left ? section.left : section.right, &to = is_left ? section.right : section.left;
    const Eigen::Vector2d across = (to - from).head<2>().normalized(), off = (place - from).head<2>();
    const double along_m = std::abs(cross(across, off)), across_m = across.dot(off);
    if (along_m < kBesideSection_m && across_m > 0.0 && across_m < section.width_m) return across_m;
  }
  return std::nullopt;
}

}  // namespace

std::optional<LaneBesideLine> driven_beside_line(std::span<const Point> way, Side line,
                                                 std::span<const CrossSection> both) {
  double sum_m = 0.0;
  int places = 0;
  for (const Point& place : way) {
    const auto from_line_m = distance_within(place, line, both);
    if (!from_line_m) continue;
    sum_m += *from_line_m;
    ++places;
  }
  if (places < kLeastPlaces) return std::nullopt;
  const double width_m = 2.0 * sum_m / places;
  const double narrowest_m = std::ranges::min(both, {}, &CrossSection::width_m).width_m;
  if (width_m < kLeastWidth_m || width_m > std::min(kMostWidth_m, narrowest_m - kLeastWidth_m))
    return std::nullopt;
  return LaneBesideLine{line, width_m};
}

}  // namespace laneloom::lanes
