#include "evaluation/kind_lines.hpp"

#include "evaluation/lane_chains.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::evaluation {
namespace {

KindLine kind_line(const Marking& marking) {
  return {.kind = line_kind(marking.type),
          .points = marking.points,
          .id = marking.id,
          .confidence = marking.existence_probability,
          .styles = marking.styles,
          .lateral_stddev_m = marking.lateral_stddev_m};
}

}  // namespace

std::vector<KindLine> kind_lines(const simulation::Road& truth) {
  std::vector<KindLine> lines;
  for (const LaneChain& chain : lane_chains(truth))
    lines.push_back({.kind = LineKind::lane, .points = centerline(chain), .id = chain.front()->id});
  for (const simulation::RoadMarking& marking : truth.markings)
    lines.push_back({.kind = line_kind(marking.type),
                     .points = marking.points,
                     .id = marking.id,
                     .styles = {{{0.0, length(marking.points)}, marking.style}}});
  return lines;
}

std::vector<KindLine> kind_lines(const LocalMap& map) {
  std::vector<KindLine> lines;
  for (const Stopline& stopline : map.stoplines) lines.push_back(kind_line(stopline.marking));
  for (const Marking& boundary : map.boundaries)
    if (boundary.status != ElementStatus::inferred) lines.push_back(kind_line(boundary));
  for (const PublishedChain& chain : lane_chains(map))
    lines.push_back({.kind = LineKind::lane,
                     .points = chain.centerline,
                     .id = chain.id,
                     .confidence = chain.existence_probability});
  return lines;
}

std::vector<KindLine> kind_lines(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                 double min_confidence) {
  std::vector<KindLine> lines;
  for (const Detection& detection : frame.detections) {
    if (detection.confidence < min_confidence) continue;
    KindLine line{.kind = line_kind(detection.type),
                  .confidence = detection.confidence,
                  .styles = {{{0.0, length(detection.points)}, detection.style}},
                  .lateral_stddev_m = detection.stddev_m};
    for (const Point& point : detection.points) line.points.push_back(T_map_body * point);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace laneloom::evaluation
