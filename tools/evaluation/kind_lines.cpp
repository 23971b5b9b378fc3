#include "evaluation/kind_lines.hpp"

#include <map>
#include <set>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

/// The visible lanes of a road, and which of them only continue one another.
class LaneChains {
 public:
  explicit LaneChains(const Road& truth) {
    std::map<ElementId, int> entries;
    for (const RoadLane& lane : truth.lanes)
      for (const ElementId next : lane.successors) ++entries[next];
    for (const RoadLane& lane : truth.lanes)
      if (lane.left_marking != kNoElement && lane.right_marking != kNoElement) lanes_.emplace(lane.id, &lane);
    for (const auto& [id, lane] : lanes_) {
      if (lane->successors.size() != 1 || entries[lane->successors.front()] != 1) continue;
      const auto next = lanes_.find(lane->successors.front());
      if (next == lanes_.end()) continue;
      next_.emplace(id, next->second);
      continues_.insert(next->first);
    }
  }

  std::vector<LaneChain> chains() const {
    std::vector<LaneChain> chains;
    std::set<ElementId> used;
    for (const auto& [id, lane] : lanes_)
      if (!continues_.contains(id)) chains.push_back(chain(*lane, used));
    for (const auto& [id, lane] : lanes_)  // what is left are rings
      if (!used.contains(id)) chains.push_back(chain(*lane, used));
    return chains;
  }

 private:
  LaneChain chain(const RoadLane& first, std::set<ElementId>& used) const {
    LaneChain lanes;
    const RoadLane* lane = &first;
    while (lane != nullptr && used.insert(lane->id).second) {
      lanes.push_back(lane);
      const auto next = next_.find(lane->id);
      lane = next == next_.end() ? nullptr : next->second;
    }
    return lanes;
  }

  std::map<ElementId, const RoadLane*> lanes_;
  std::map<ElementId, const RoadLane*> next_;
  std::set<ElementId> continues_;
};

KindLine kind_line(const Marking& marking) {
  return {.kind = line_kind(marking.type),
          .points = marking.points,
          .id = marking.id,
          .confidence = marking.existence_probability,
          .styles = marking.styles,
          .lateral_stddev_m = marking.lateral_stddev_m};
}

}  // namespace

std::vector<LaneChain> lane_chains(const Road& truth) { return LaneChains(truth).chains(); }

Polyline centerline(const LaneChain& chain) {
  Polyline points;
  for (const RoadLane* lane : chain)
    points.insert(points.end(), lane->centerline.begin(), lane->centerline.end());
  return points;
}

std::vector<KindLine> kind_lines(const Road& truth) {
  std::vector<KindLine> lines;
  for (const LaneChain& chain : lane_chains(truth))
    lines.push_back({.kind = LineKind::lane, .points = centerline(chain), .id = chain.front()->id});
  for (const RoadMarking& marking : truth.markings)
    lines.push_back({.kind = line_kind(marking.type),
                     .points = marking.points,
                     .id = marking.id,
                     .styles = {{{0.0, length(marking.points)}, marking.style}}});
  return lines;
}

std::vector<KindLine> kind_lines(const LocalMap& map) {
  std::vector<KindLine> lines;
  for (const Marking& boundary : map.boundaries) lines.push_back(kind_line(boundary));
  for (const Stopline& stopline : map.stoplines) lines.push_back(kind_line(stopline.marking));
  for (const Lane& lane : map.lanes)
    lines.push_back({.kind = LineKind::lane,
                     .points = lane.centerline,
                     .id = lane.id,
                     .confidence = lane.existence_probability});
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

}  // namespace laneloom
