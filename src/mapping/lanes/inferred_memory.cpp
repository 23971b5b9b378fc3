#include "mapping/lanes/inferred_memory.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kSameInferred_m = 1.5;  // a nearer inferred boundary is taken for a known one

/// The number of points of a found boundary that cover a known one; `found` and `known` are indices.
struct Likeness {
  std::size_t points = 0, found = 0, known = 0;
};

/// Per found boundary, the known one that it is taken for. Each is taken once; what covers most comes first.
using Recognition = std::vector<std::optional<std::size_t>>;

Recognition settled(std::vector<Likeness> likenesses, std::size_t found, std::size_t known) {
  Recognition known_of(found);
  std::vector<bool> taken(known, false);
  std::ranges::stable_sort(likenesses, std::greater{}, &Likeness::points);
  for (const Likeness& likeness : likenesses) {
    if (known_of[likeness.found] || taken[likeness.known]) continue;
    known_of[likeness.found] = likeness.known;
    taken[likeness.known] = true;
  }
  return known_of;
}

bool covers_enough(std::size_t covered, const Polyline& one, const Polyline& other) {
  return 2 * covered >= std::min(one.size(), other.size());
}

Recognition recognised(const std::vector<Marking*>& inferred, const std::vector<KnownInferred>& known,
                       std::uint64_t frame) {
  std::vector<Box> boxes;
  boxes.reserve(inferred.size());
  for (const Marking* one : inferred) boxes.push_back(box_around(one->points));
  std::vector<Likeness> likenesses;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (known[k].last_frame == frame) continue;  // it has been recognised already
    const MeasuredPolyline line(known[k].points);
    const Box near = box_around(known[k].points, kSameInferred_m);
    for (std::size_t i = 0; i < inferred.size(); ++i) {
      if (!near.intersects(boxes[i])) continue;
      const Polyline& points = inferred[i]->points;
      const std::size_t covered = points_beside(points, line, kSameInferred_m);
      if (covers_enough(covered, points, known[k].points)) likenesses.push_back({covered, i, k});
    }
  }
  return settled(std::move(likenesses), inferred.size(), known.size());
}

bool is_expired(std::uint64_t last_frame, const geometry::Scene& scene, const LaneConfig& config) {
  return last_frame + static_cast<std::uint64_t>(config.id_memory_frames) < scene.frame;
}

}  // namespace

void InferredMemory::identify(const std::vector<Marking*>& inferred, const geometry::Scene& scene,
                              markings::IdSource& ids) {
  const Recognition recognition = recognised(inferred, inferred_, scene.frame);
  for (std::size_t i = 0; i < inferred.size(); ++i) {
    const auto same = recognition[i];
    if (!same) inferred_.push_back({.id = ids.next(), .first_seen_ns = scene.stamp_ns, .points = {}});
    KnownInferred& known = same ? inferred_[*same] : inferred_.back();
    Marking& marking = *inferred[i];
    marking.id = known.id;
    marking.first_seen_ns = known.first_seen_ns;
    known.points = marking.points;
    known.last_frame = scene.frame;
  }
}

LaneLayout InferredMemory::recognise(FoundLanes found, const geometry::Scene& scene, const LaneConfig& config,
                                     markings::IdSource& ids) {
  identify(markings_of(found.inferred), scene, ids);
  std::erase_if(inferred_, [&](const KnownInferred& k) { return is_expired(k.last_frame, scene, config); });
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
