#include "mapping/lanes/known_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kSame_m = 1.5;  // a nearer line is taken for a known one

/// The number of points of a found line that cover a known one; `found` and `known` are indices.
struct Likeness {
  std::size_t points = 0, found = 0, known = 0;
};

/// Per found line, the known one that it is taken for. Each is taken once; what covers most comes first.
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

Recognition recognised(const std::vector<const Polyline*>& found, const std::vector<KnownLine>& known,
                       std::uint64_t frame) {
  std::vector<Box> boxes;
  boxes.reserve(found.size());
  for (const Polyline* points : found) boxes.push_back(box_around(*points));
  std::vector<Likeness> likenesses;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (known[k].last_frame == frame) continue;  // it has been recognised already
    const MeasuredPolyline line(known[k].points);
    const Box near = box_around(known[k].points, kSame_m);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!near.intersects(boxes[i])) continue;
      const std::size_t covered = points_beside(*found[i], line, kSame_m);
      if (covers_enough(covered, *found[i], known[k].points)) likenesses.push_back({covered, i, k});
    }
  }
  return settled(std::move(likenesses), found.size(), known.size());
}

}  // namespace

std::vector<LineIdentity> KnownLines::identify(const std::vector<const Polyline*>& found,
                                               const geometry::Scene& scene, markings::IdSource& ids) {
  const Recognition recognition = recognised(found, lines_, scene.frame);
  std::vector<LineIdentity> identified;
  identified.reserve(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto same = recognition[i];
    if (!same) lines_.push_back({{.id = ids.next(), .first_seen_ns = scene.stamp_ns}, {}});
    KnownLine& known = same ? lines_[*same] : lines_.back();
    known.points = *found[i];
    known.last_frame = scene.frame;
    identified.push_back(known);
  }
  return identified;
}

void KnownLines::forget(const geometry::Scene& scene, int memory_frames) {
  std::erase_if(lines_, [&](const KnownLine& known) {
    return known.last_frame + static_cast<std::uint64_t>(memory_frames) < scene.frame;
  });
}

}  // namespace laneloom::lanes
