#include "export/driven_over.hpp"

#include <algorithm>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/lines/driven_over.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {
namespace {

constexpr double kMaxStep_m = 5.0;  // between poses of one pass
constexpr double kSampleStep_m = 0.5;
constexpr double kMinRest_m = 2.0;

/// The ways that the vehicle drove, one per pass.
std::vector<MeasuredPolyline> ways_of(const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<Polyline> passes;
  for (const Eigen::Isometry3d& pose : poses) {
    const Point place = pose.translation();
    const bool goes_on = !passes.empty() && (place - passes.back().back()).norm() <= kMaxStep_m;
    if (!goes_on) passes.emplace_back();
    passes.back().push_back(place);
  }
  return {passes.begin(), passes.end()};
}

bool is_driven_over(const Point& point, const std::vector<MeasuredPolyline>& ways) {
  return std::ranges::any_of(ways, [&](const MeasuredPolyline& way) {
    const Projection foot = way.project(point, lines::kHalfBody_m);
    return foot.inside && foot.distance_m < lines::kHalfBody_m && geometry::same_level(foot.foot, point);
  });
}

/// The stretches of a line that were not driven over; the whole line if none of it was.
std::vector<Stretch> remaining_stretches(const MeasuredPolyline& line,
                                         const std::vector<MeasuredPolyline>& ways) {
  std::vector<Stretch> stretches;
  const Polyline samples = line.resample(kSampleStep_m);
  bool goes_on = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double arc_m = line.length() * static_cast<double>(i) / static_cast<double>(samples.size() - 1);
    const bool remains = !is_driven_over(samples[i], ways);
    if (remains && !goes_on) stretches.push_back({arc_m, arc_m});
    if (remains) stretches.back().to_m = arc_m;
    goes_on = remains;
  }
  return stretches;
}

}  // namespace

std::vector<Marking> without_edges_driven_over(const std::vector<Marking>& markings,
                                               const std::vector<Eigen::Isometry3d>& poses) {
  const std::vector<MeasuredPolyline> ways = ways_of(poses);
  std::vector<Marking> kept;
  for (const Marking& marking : markings) {
    if (marking.type != MarkingType::roadedge) {
      kept.push_back(marking);
      continue;
    }
    for (const Stretch& stretch : remaining_stretches(MeasuredPolyline(marking.points), ways))
      if (stretch.to_m - stretch.from_m >= kMinRest_m) kept.push_back(markings::slice(marking, stretch));
  }
  for (ElementId id = 0; Marking & marking : kept) marking.id = ++id;
  return kept;
}

}  // namespace laneloom::exports
