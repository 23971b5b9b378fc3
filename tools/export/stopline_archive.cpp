#include "export/stopline_archive.hpp"

#include <algorithm>
#include <cmath>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::exports {
namespace {

constexpr double kSame_m = 1.5;    // along the lane, between the middles of two that are the same
constexpr double kMinAlong = 0.9;  // cosine between two that are the same
constexpr double kUnknownStddev_m = 0.3;

Point middle(const Marking& stopline) { return 0.5 * (stopline.points.front() + stopline.points.back()); }

double stddev_of(const Marking& stopline) {
  return stopline.lateral_stddev_m.empty() ? kUnknownStddev_m : stopline.lateral_stddev_m.front();
}

bool is_same(const Marking& a, const Marking& b) {
  const Eigen::Vector2d along_a = (a.points.back() - a.points.front()).head<2>().normalized();
  const Eigen::Vector2d along_b = (b.points.back() - b.points.front()).head<2>().normalized();
  const Eigen::Vector2d offset = (middle(b) - middle(a)).head<2>();
  return std::abs(cross(along_a, offset)) < kSame_m && std::abs(along_a.dot(along_b)) > kMinAlong &&
         offset.norm() < 0.5 * (length(a.points) + length(b.points)) &&
         geometry::same_level(middle(a), middle(b));
}

}  // namespace

void StoplineArchive::add(const Marking& stopline) {
  const auto same =
      std::ranges::find_if(markings_, [&](const Marking& known) { return is_same(stopline, known); });
  if (same == markings_.end()) {
    markings_.push_back(stopline);
  } else if (stddev_of(stopline) < stddev_of(*same)) {
    *same = stopline;
  }
}

}  // namespace laneloom::exports
