#include "mapping/lanes/lane_memory.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lanes/lane_geometry.hpp"
#include "mapping/lanes/neighbours.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kSameInferred_m = 1.5;  // a nearer inferred boundary is taken for a known one

/// The number of a found element's points that cover a known element; `found` and `known` are indices.
struct Cover {
  std::size_t points = 0, found = 0, known = 0;
};

/// Takes each found element for at most one known element, and the other way round.
class Recognition {
 public:
  Recognition(std::size_t found, std::size_t known) : known_of_(found), taken_(known, false) {}

  bool is_open(std::size_t found, std::size_t known) const { return !known_of_[found] && !taken_[known]; }
  /// Takes found elements for known ones; those that cover most come first.
  void settle(std::vector<Cover> covers) {
    std::ranges::stable_sort(covers, std::greater{}, &Cover::points);
    for (const Cover& cover : covers) {
      if (!is_open(cover.found, cover.known)) continue;
      known_of_[cover.found] = cover.known;
      taken_[cover.known] = true;
    }
  }
  std::optional<std::size_t> known_of(std::size_t found) const { return known_of_[found]; }
  bool is_taken(std::size_t known) const { return taken_[known]; }

 private:
  std::vector<std::optional<std::size_t>> known_of_;
  std::vector<bool> taken_;
};

bool covers_enough(std::size_t covered, const Polyline& one, const Polyline& other) {
  return 2 * covered >= std::min(one.size(), other.size());
}

Recognition recognised(const std::vector<Marking*>& inferred, const std::vector<KnownInferred>& known,
                       std::uint64_t frame) {
  std::vector<Box> boxes;
  boxes.reserve(inferred.size());
  for (const Marking* one : inferred) boxes.push_back(box_around(one->points));
  std::vector<Cover> covers;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (known[k].last_frame == frame) continue;  // it has been recognised already
    const MeasuredPolyline line(known[k].points);
    const Box near = box_around(known[k].points, kSameInferred_m);
    for (std::size_t i = 0; i < inferred.size(); ++i) {
      if (!near.intersects(boxes[i])) continue;
      const Polyline& points = inferred[i]->points;
      const std::size_t covered = points_beside(points, line, kSameInferred_m);
      if (covers_enough(covered, points, known[k].points)) covers.push_back({covered, i, k});
    }
  }
  Recognition recognition(inferred.size(), known.size());
  recognition.settle(std::move(covers));
  return recognition;
}

std::pair<ElementId, ElementId> boundary_pair(const Lane& lane) {
  return std::minmax(lane.left_borders.front().boundary, lane.right_borders.front().boundary);
}

bool has_same_boundaries(const Lane& lane, const KnownLane& known) {
  return boundary_pair(lane) == std::pair(known.boundary_a, known.boundary_b);
}

/// Which pairs of a found and a known lane are compared.
struct Round {
  std::uint64_t frame = 0;
  bool recent = false;           ///< with lanes of the map before this frame, else with older ones
  bool same_boundaries = false;  ///< between the same boundaries, else between others
};

/// The covers of known lanes by lanes that are not yet recognised.
std::vector<Cover> covers_of(const std::vector<Lane>& lanes, const std::vector<KnownLane>& known,
                             const Recognition& recognition, double max_distance_m, const Round& round) {
  const bool same_boundaries = round.same_boundaries;
  std::vector<Cover> covers;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if ((known[k].last_frame + 1 == round.frame) != round.recent) continue;
    std::optional<MeasuredPolyline> line;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      if (!recognition.is_open(i, k) || has_same_boundaries(lanes[i], known[k]) != same_boundaries) continue;
      if (!line) line.emplace(known[k].centerline);
      const Polyline& centerline = lanes[i].centerline;
      const std::size_t covered = points_beside(centerline, *line, max_distance_m);
      const bool is_same =
          same_boundaries ? covered > 0 : covers_enough(covered, centerline, known[k].centerline);
      if (is_same) covers.push_back({covered, i, k});
    }
  }
  return covers;
}

/// Recognises lanes of the last map first, so that a lane whose boundary was taken for another one keeps its
/// id; of these, lanes between the same boundaries first, and then lanes that lie where a known lane lay.
Recognition recognised(const std::vector<Lane>& lanes, const std::vector<KnownLane>& known,
                       std::uint64_t frame, const LaneConfig& config) {
  Recognition recognition(lanes.size(), known.size());
  for (const bool recent : {true, false})
    for (const bool same_boundaries : {true, false})
      recognition.settle(covers_of(lanes, known, recognition, 0.5 * config.min_width_m,
                                   {.frame = frame, .recent = recent, .same_boundaries = same_boundaries}));
  return recognition;
}

/// Whether the first line runs as the second does, in the middle of the first.
bool same_way(const Polyline& line, const Polyline& other) {
  const MeasuredPolyline measured(line), measured_other(other);
  const double middle_m = 0.5 * measured.length();
  const Projection foot = measured_other.project(measured.at(middle_m));
  return measured.direction(middle_m).dot(measured_other.direction(foot)) >= 0.0;
}

bool is_expired(std::uint64_t last_frame, const geometry::Scene& scene, const LaneConfig& config) {
  return last_frame + static_cast<std::uint64_t>(config.id_memory_frames) < scene.frame;
}

}  // namespace

void LaneMemory::identify(const std::vector<Marking*>& inferred, const geometry::Scene& scene,
                          markings::IdSource& ids) {
  const Recognition recognition = recognised(inferred, inferred_, scene.frame);
  for (std::size_t i = 0; i < inferred.size(); ++i) {
    const auto same = recognition.known_of(i);
    if (!same) inferred_.push_back({.id = ids.next(), .first_seen_ns = scene.stamp_ns, .points = {}});
    KnownInferred& known = same ? inferred_[*same] : inferred_.back();
    Marking& marking = *inferred[i];
    marking.id = known.id;
    marking.first_seen_ns = known.first_seen_ns;
    known.points = marking.points;
    known.last_frame = scene.frame;
  }
}

void LaneMemory::identify(std::vector<Lane>& lanes, const geometry::Scene& scene, const LaneConfig& config,
                          markings::IdSource& ids) {
  const Recognition recognition = recognised(lanes, lanes_, scene.frame, config);
  std::vector<KnownLane> now;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    Lane& lane = lanes[i];
    const auto [a, b] = boundary_pair(lane);
    KnownLane known{
        .boundary_a = a, .boundary_b = b, .centerline = lane.centerline, .last_frame = scene.frame};
    if (const auto same = recognition.known_of(i)) {
      const KnownLane& before = lanes_[*same];
      const int sense = same_way(lane.centerline, before.centerline) ? 1 : -1;
      known.id = before.id;
      known.direction_log_odds = sense * before.direction_log_odds;
      known.kept_direction = sense * before.kept_direction;
      known.belief = sense * before.belief;
      known.told_direction = sense * before.told_direction;
      known.published = sense * before.published;
      known.driven = before.driven;
    } else {
      known.id = ids.next();
    }
    lane.id = known.id;
    now.push_back(std::move(known));
  }
  std::size_t k = 0;
  std::erase_if(lanes_, [&](const KnownLane& known) {
    return recognition.is_taken(k++) || is_expired(known.last_frame, scene, config);
  });
  std::ranges::move(now, std::back_inserter(lanes_));
  std::ranges::sort(lanes, {}, &Lane::id);
}

LaneLayout LaneMemory::recognise(FoundLanes found, const geometry::Scene& scene, const LaneConfig& config,
                                 markings::IdSource& ids) {
  identify(markings_of(found.inferred), scene, ids);
  std::erase_if(inferred_, [&](const KnownInferred& k) { return is_expired(k.last_frame, scene, config); });
  LaneLayout layout = laid_out(std::move(found));
  identify(layout.lanes, scene, config, ids);
  find_neighbours(layout);
  return layout;
}

std::vector<boundaries::LaneBoundary> LaneMemory::recognise(std::vector<Marking> inferred,
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

std::map<ElementId, ElementId> LaneMemory::publish(const std::vector<Lane>& lanes, markings::IdSource& ids) {
  std::map<ElementId, ElementId> renamed;
  for (const Lane& lane : lanes) {
    KnownLane* known = find(lane.id);
    if (known == nullptr) continue;
    const int sense = lane.centerline.front() == known->centerline.front() ? 1 : -1;
    if (known->published == -sense) {
      known->id = ids.next();
      renamed.emplace(lane.id, known->id);
    }
    if (sense < 0) std::ranges::reverse(known->centerline);
    known->direction_log_odds *= sense;
    known->kept_direction *= sense;
    known->belief *= sense;
    known->told_direction = lane.direction == Lane::Direction::unknown ? 0 : 1;
    known->published = 1;
  }
  return renamed;
}

const KnownLane* LaneMemory::find(ElementId lane) const {
  const auto found = std::ranges::find(lanes_, lane, &KnownLane::id);
  return found == lanes_.end() ? nullptr : &*found;
}

KnownLane* LaneMemory::find(ElementId lane) {
  return const_cast<KnownLane*>(std::as_const(*this).find(lane));  // NOLINT: of this memory
}

}  // namespace laneloom::lanes
