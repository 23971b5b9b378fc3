#include "mapping/lines/station_update.hpp"

#include <algorithm>

#include "mapping/geometry/left_of.hpp"
#include "mapping/lines/frame_pitch.hpp"

namespace laneloom::lines {
namespace {

constexpr double kNear_m = 10.0;  // a view from within this range is taken as right
// Least and greatest deviation of a sample, whatever its network says. A huge one says that nothing is known.
constexpr double kMinStddev_m = 0.02, kMaxStddev_m = 10.0;

double distance(const Point& point, const Point& origin) { return (point - origin).head<2>().norm(); }

/// The furthest node of the model that is not beyond a range.
std::size_t ring(double range_m) {
  const auto& nodes_m = NetworkModel::kNodes_m;
  return static_cast<std::size_t>(std::upper_bound(nodes_m.begin() + 1, nodes_m.end(), range_m) -
                                  nodes_m.begin() - 1);
}

}  // namespace

void weigh(const NetworkModel& network, const Point& origin, std::vector<SampledDetection>& detections) {
  for (SampledDetection& detection : detections) {
    detection.stddev_m.reserve(detection.samples.size());
    if (detection.stddev_m.empty())
      for (const Point& sample : detection.samples)
        detection.stddev_m.push_back(network.stddev_m(distance(sample, origin)));
    for (double& stddev_m : detection.stddev_m) stddev_m = std::clamp(stddev_m, kMinStddev_m, kMaxStddev_m);
  }
}

Station new_station(const Point& position, const Viewpoint& from, const SampledDetection& detection,
                    std::size_t sample, double log_odds) {
  const LateralView first{.stddev_m = detection.stddev_m[sample],
                          .seen_from = from.T_map_body.translation().head<2>(),
                          .stamp_ns = from.stamp_ns};
  Station station{.position = position, .lateral = LateralFilter(first), .log_odds = log_odds};
  // The map did not know it: a line that is born beside one that the frame observed may be its double, and
  // counts as seen apart from it.
  station.sight = Sight::missed;
  station.type_votes[index(detection.type)] = 1.0;
  station.style_votes[index(detection.style)] = 1.0;
  return station;
}

void observe(const Observation& seen, const Viewpoint& from, Station& station) {
  const double step_m = station.lateral.update({.lateral_m = seen.lateral_m,
                                                .stddev_m = seen.stddev_m,
                                                .seen_from = from.T_map_body.translation().head<2>(),
                                                .stamp_ns = from.stamp_ns});
  station.moved_m += step_m;
  station.position.head<2>() += step_m * geometry::left_of(seen.direction);
  const double share = seen.lateral_m != 0.0 ? std::clamp(step_m / seen.lateral_m, 0.0, 1.0) : 0.0;
  station.position.z() += share * seen.height_m;
}

void learn(const Observation& seen, const Viewpoint& from, Station& station, Networks& networks) {
  const double range_m = distance(station.position, from.T_map_body.translation());
  const bool is_far = range_m > kNear_m;
  auto& views = station.far_views;
  const auto is_known = [](const FarView& view) { return view.source != FarView::kNone; };
  if (is_far ? is_known(views[ring(range_m)]) : std::ranges::none_of(views, is_known)) return;
  const Point& place = station.position;
  const Eigen::Vector2d left = geometry::left_of(seen.direction);
  const PerSuspicion suspected_m{left.dot(stretched_by(from.stretch.sudden_per_m, place, from.T_map_body)),
                                 left.dot(stretched_by(from.stretch.lasting_per_m, place, from.T_map_body)),
                                 left.dot(shifted_by(from.error, place, from.T_map_body))};
  const double said_m = station.moved_m + seen.lateral_m + from.gains.dot(suspected_m);
  if (is_far) {
    views[ring(range_m)] = {from.source, range_m, said_m, suspected_m};
    return;
  }
  for (const FarView& view : views)
    if (is_known(view)) networks[view.source].lateral.learn(view, said_m);
  views.fill({});
}

}  // namespace laneloom::lines
