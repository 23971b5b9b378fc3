#include "mapping/lanes/inferred_memory.hpp"

#include <cstddef>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::lanes {

void InferredMemory::identify(const std::vector<Marking*>& inferred, const geometry::Scene& scene,
                              markings::IdSource& ids) {
  std::vector<const Polyline*> lines;
  lines.reserve(inferred.size());
  for (const Marking* marking : inferred) lines.push_back(&marking->points);
  const std::vector<LineIdentity> known = known_.identify(lines, scene, ids);
  for (std::size_t i = 0; i < inferred.size(); ++i) {
    inferred[i]->id = known[i].id;
    inferred[i]->first_seen_ns = known[i].first_seen_ns;
  }
}

LaneLayout InferredMemory::recognise(FoundLanes found, const geometry::Scene& scene, const LaneConfig& config,
                                     markings::IdSource& ids) {
  identify(markings_of(found.inferred), scene, ids);
  known_.forget(scene, config.id_memory_frames);
  return laid_out(std::move(found));
}

std::vector<boundaries::LaneBoundary> InferredMemory::recognise(std::vector<Marking> inferred,
                                                                const geometry::Scene& scene,
                                                                markings::IdSource& ids) {
  std::vector<Marking*> markings;
  markings.reserve(inferred.size());
  for (Marking& marking : inferred) markings.push_back(&marking);
  identify(markings, scene, ids);
  std::vector<boundaries::LaneBoundary> result;
  for (Marking& marking : inferred) {
    const ElementId id = marking.id;
    const Stretch whole{0.0, length(marking.points)};
    result.push_back({.marking = std::move(marking), .members = {id}, .bridged = {whole}});
  }
  return result;
}

}  // namespace laneloom::lanes
