#include "export/stopline_archive.hpp"

#include <algorithm>
#include <cmath>

#include "export/archived_line.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"

namespace laneloom::exports {
namespace {

constexpr double kSame_m = 1.5;    // along the lane, between the middles of two that are the same
constexpr double kParallel = 0.9;  // cosine between two that are the same

Point middle(const Marking& stopline) { return 0.5 * (stopline.points.front() + stopline.points.back()); }

double stddev_of(const Marking& stopline) {
  return stopline.lateral_stddev_m.empty() ? kUnknownStddev_m : stopline.lateral_stddev_m.front();
}

bool is_same(const Marking& a, const Marking& b) {
  const Eigen::Vector2d along_a = (a.points.back() - a.points.front()).head<2>().normalized();
  const Eigen::Vector2d along_b = (b.points.back() - b.points.front()).head<2>().normalized();
  const Eigen::Vector2d offset = (middle(b) - middle(a)).head<2>();
  return std::abs(cross(along_a, offset)) < kSame_m && std::abs(along_a.dot(along_b)) > kParallel &&
         offset.norm() < 0.5 * (length(a.points) + length(b.points)) &&
         geometry::same_level(middle(a), middle(b));
}

/// The mean of the middles of two.
Point mean_place(const Marking& a, double weight_a, const Marking& b, double weight_b) {
  return (weight_a * middle(a) + weight_b * middle(b)) / (weight_a + weight_b);
}

/// Moves a stopline along the lane that it crosses, until it lies beside a place.
void move_to(const Point& place, Marking& stopline) {
  const Eigen::Vector2d across = (stopline.points.back() - stopline.points.front()).head<2>().normalized();
  const Eigen::Vector2d along(-across.y(), across.x());
  const double by_m = along.dot((place - middle(stopline)).head<2>());
  for (Point& point : stopline.points) point.head<2>() += by_m * along;
}

}  // namespace

void StoplineArchive::add(const Marking& stopline, std::size_t drive, const DrivenPlaces& before) {
  const double weight = 1.0 / (stddev_of(stopline) * stddev_of(stopline));
  const auto same =
      std::ranges::find_if(entries_, [&](const Entry& known) { return is_same(stopline, known.marking); });
  if (same == entries_.end()) {
    entries_.push_back({stopline, MeasuredPolyline(stopline.points), weight,
                        Votes::of_new(drive, before.passed(middle(stopline)))});
    return;
  }
  same->votes.see(drive);
  const Point place = mean_place(same->marking, same->weight, stopline, weight);
  if (stddev_of(stopline) < stddev_of(same->marking)) same->marking = stopline;
  move_to(place, same->marking);
  same->course = MeasuredPolyline(same->marking.points);
  same->weight += weight;
}

void StoplineArchive::end_drive(std::size_t drive, const DrivenPlaces& places) {
  for (Entry& entry : entries_)
    if (places.passed_last(middle(entry.marking), drive)) entry.votes.pass(drive);
}

}  // namespace laneloom::exports
