#include "evaluation/map_evaluation.hpp"

namespace laneloom::evaluation {
namespace {

std::vector<KindLine> truth_lines(const simulation::Road& truth, Subject subject) {
  std::vector<KindLine> lines = kind_lines(truth);
  if (subject == Subject::detections)
    std::erase_if(lines, [](const KindLine& line) { return line.kind == LineKind::lane; });
  return lines;
}

}  // namespace

MapEvaluation::MapEvaluation(const simulation::Road& truth, const RangeConfig& range, Subject subject)
    : truth_(truth_lines(truth, subject)),
      truth_topology_(truth_topology(truth)),
      range_(range),
      stability_(truth_, range),
      trust_(truth_, range),
      profile_(range),
      steadiness_(truth),
      lane_metres_(truth, range) {}

FrameComparison MapEvaluation::add_lines(std::int64_t stamp_ns, const Eigen::Isometry3d& T_map_body,
                                         const std::vector<KindLine>& lines) {
  FrameComparison frame = compare(truth_, lines, T_map_body, range_);
  frame.stamp_ns = stamp_ns;
  evaluation::add(frame, score_);
  stability_.add(frame, lines);
  average_precision_.add(frame, lines);
  trust_.add(frame, lines);
  profile_.add(frame);
  add_styles(frame, truth_, lines, styles_);
  return frame;
}

void MapEvaluation::add(const LocalMap& map) {
  const FrameComparison frame = add_lines(map.stamp_ns, map.T_map_body, kind_lines(map));
  add_topology(truth_topology_, frame, map, range_, topology_);
  add_top_ll(truth_topology_, frame, map, range_, top_ll_);
  steadiness_.add(map);
  lane_metres_.add(map);
}

void MapEvaluation::add(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                        double min_confidence) {
  add_lines(frame.stamp_ns, T_map_body, kind_lines(frame, T_map_body, min_confidence));
}

}  // namespace laneloom::evaluation
