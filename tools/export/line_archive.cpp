#include "export/line_archive.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "mapping/geometry/levels.hpp"

namespace laneloom::exports {
namespace {

constexpr double kMinAlong = 0.9;  // cosine between a piece and the line that it lies along
constexpr double kAtEnd_m = 1.5;   // a match that is nearer to the line's end leads beyond it
constexpr std::uint64_t kMinObservations = 15;
constexpr double kMinExistence = 0.7;
constexpr double kNearEnd_m = 2.0;     // vertices this near to a line's end continue it only if they lead on
constexpr double kLeast_m = 0.3;       // that they lead on
constexpr double kMinChange_m = 10.0;  // length of a stretch that is gone or new
constexpr int kMinDrives = 3;          // that agree, before the others say otherwise

/// Whether a marking was seen as seldom, or is believed in as little, as lines that are not there sometimes
/// are. Maps of others need not tell how often it was seen.
bool is_doubtful(const Marking& marking) {
  const double existence = marking.existence_probability;
  return (existence >= 0.0 && existence < kMinExistence) || marking.status == ElementStatus::tentative ||
         (marking.observations > 0 && marking.observations < kMinObservations);
}

bool is_gone(const Votes& votes) { return !votes.believed() && votes.seen >= kMinDrives; }
bool is_new(const Votes& votes) { return votes.believed() && votes.against >= kMinDrives; }

/// Appends the stretches of a line for which `is_changed` holds.
template <class IsChanged>
void append_changes(const ArchivedLine& line, bool gone, IsChanged is_changed, std::vector<Change>& changes) {
  Change run{.gone = gone, .type = line.type, .points = {}};
  const auto end_run = [&] {
    if (length(run.points) >= kMinChange_m) changes.push_back(run);
    run.points.clear();
  };
  for (const ArchivedVertex& vertex : line.vertices) {
    if (!is_changed(vertex)) {
      end_run();
      continue;
    }
    if (run.points.empty()) run.drive = vertex.votes.first_drive;
    run.drive =
        gone ? std::max(run.drive, vertex.votes.last_drive) : std::min(run.drive, vertex.votes.first_drive);
    run.points.push_back(vertex.position);
  }
  end_run();
}

}  // namespace

void LineArchive::add_to_tiles(std::size_t k, const Vertices& vertices) {
  for (const ArchivedVertex& vertex : vertices) tiles_.add(k, vertex.position);
}

std::vector<LineArchive::Match> LineArchive::match(const ArchivedPiece& piece,
                                                   const Vertices& vertices) const {
  std::vector<Match> matches(vertices.size(), Match{.line = kNoLine});
  const auto is_another = [&](const ArchivedVertex::Source& source) {
    return source.first == piece.pass && std::ranges::find(piece.beside, source.second) != piece.beside.end();
  };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point& point = vertices[i].position;
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, vertices.size() - 1);
    const Eigen::Vector2d along = (vertices[after].position - vertices[before].position).head<2>();
    double nearest_m = kSameLine_m;
    for (const std::size_t k : tiles_.near(point)) {
      const ArchivedLine& line = lines_[k];
      if (line.type != piece.marking.type || !line.box.contains(point.head<2>())) continue;
      const Projection foot = line.course.project(point, kSameLine_m);
      if (!foot.inside || foot.distance_m >= kSameLine_m || !geometry::same_level(foot.foot, point)) continue;
      const ArchivedVertex::Source& source = line.vertices[foot.segment].source;
      const double distance_m = source == vertices[i].source ? 0.0 : foot.distance_m;
      if (distance_m >= nearest_m || is_another(source)) continue;
      if (std::abs(line.course.direction(foot).dot(along)) < kMinAlong * along.norm()) continue;
      nearest_m = distance_m;
      matches[i] = {k, foot.arc_m};
    }
  }
  return matches;
}

void LineArchive::fuse(const Vertices& piece, std::size_t k) {
  Polyline points;
  for (const ArchivedVertex& vertex : piece) points.push_back(vertex.position);
  const MeasuredPolyline course(points);
  for (ArchivedVertex& vertex : lines_[k].vertices) {
    const Projection foot = course.project(vertex.position, kSameLine_m);
    if (!foot.inside || foot.distance_m >= kSameLine_m || !geometry::same_level(foot.foot, vertex.position))
      continue;
    const ArchivedVertex& seen = piece[std::min(foot.segment, piece.size() - 1)];
    vertex.position += seen.weight / (seen.weight + vertex.weight) * (foot.foot - vertex.position);
    tiles_.add(k, vertex.position);
    vertex.source = seen.source;
    vertex.maps += seen.maps;
    vertex.beside += seen.beside;
    vertex.weight += seen.weight;
    vertex.stddev_m = std::min(vertex.stddev_m, seen.stddev_m);
    vertex.existence = std::max(vertex.existence, seen.existence);
    vertex.confirmed = vertex.confirmed || seen.confirmed;
    for (std::size_t style = 0; style < kMarkingStyleCount; ++style)
      vertex.styles[style] += seen.styles[style];
    vertex.votes.see(drive_);
  }
  lines_[k].measure();
}

bool LineArchive::extend(const Match& beside, const Vertices& beyond) {
  ArchivedLine& line = lines_[beside.line];
  const bool at_back = line.course.length() - beside.arc_m <= kAtEnd_m;
  if (!at_back && beside.arc_m > kAtEnd_m) return false;
  const Point& end = at_back ? line.vertices.back().position : line.vertices.front().position;
  const Eigen::Vector2d leaving = end_direction(line.course.points(), at_back ? End::back : End::front);
  Vertices added = beyond;
  std::erase_if(added, [&](const ArchivedVertex& vertex) {
    const Eigen::Vector2d from_end = (vertex.position - end).head<2>();
    return from_end.norm() < kNearEnd_m && from_end.dot(leaving) < kLeast_m;
  });
  if (added.empty()) return true;
  line.vertices.insert(at_back ? line.vertices.end() : line.vertices.begin(), added.begin(), added.end());
  if (!at_back) std::reverse(line.vertices.begin(), line.vertices.begin() + std::ssize(added));
  add_to_tiles(beside.line, added);
  line.measure();
  return true;
}

void LineArchive::credit(const ArchivedPiece& piece, ArchivedLine& line) {
  const Marking& marking = piece.marking;
  const bool is_first = line.observations == 0;
  line.observations = std::max(line.observations, marking.observations);
  line.first_seen_ns = is_first ? marking.first_seen_ns : std::min(line.first_seen_ns, marking.first_seen_ns);
  line.last_seen_ns = std::max(line.last_seen_ns, marking.last_seen_ns);
}

void LineArchive::add_unmatched(const ArchivedPiece& piece, const Vertices& vertices,
                                const std::vector<Match>& matches) {
  for (std::size_t begin = 0, end = 0; begin < vertices.size(); begin = std::max(end, begin + 1)) {
    end = begin;
    while (end < vertices.size() && matches[end].line == kNoLine) ++end;
    if (end == begin) continue;
    Vertices run(vertices.begin() + static_cast<std::ptrdiff_t>(begin),
                 vertices.begin() + static_cast<std::ptrdiff_t>(end));
    for (ArchivedVertex& vertex : run) vertex.votes = Votes::of_new(drive_, places_.passed(vertex.position));
    const bool grown = begin > 0 && extend(matches[begin - 1], run);
    Vertices backwards(run.rbegin(), run.rend());
    if (!grown && !(end < vertices.size() && extend(matches[end], backwards)) && run.size() > 1) {
      ArchivedLine& line = lines_.emplace_back();
      line.type = piece.marking.type;
      line.vertices = std::move(run);
      credit(piece, line);
      add_to_tiles(lines_.size() - 1, line.vertices);
      line.measure();
    }
  }
}

void LineArchive::add(const ArchivedPiece& piece) {
  if (piece.marking.type == MarkingType::stopline) return stoplines_.add(piece.marking, drive_, places_);
  if (!(length(piece.marking.points) > 0.0)) return;
  const Vertices vertices = vertices_of(piece);
  const std::vector<Match> matches = match(piece, vertices);
  std::set<std::size_t> matched;
  for (const Match& match : matches)
    if (match.line != kNoLine) matched.insert(match.line);
  for (const std::size_t k : matched) {
    fuse(vertices, k);
    credit(piece, lines_[k]);
  }
  add_unmatched(piece, vertices, matches);
}

void LineArchive::end_drive(const std::vector<Eigen::Isometry3d>& poses) {
  std::set<std::size_t> beside;
  for (const Eigen::Isometry3d& pose : poses) {
    places_.add(pose.translation(), drive_);
    tiles_.add_within(DrivenPlaces::kReach_m, pose.translation(), beside);
  }
  for (const std::size_t k : beside)
    for (ArchivedVertex& vertex : lines_[k].vertices)
      if (places_.passed_last(vertex.position, drive_)) vertex.votes.pass(drive_);
  stoplines_.end_drive(drive_, places_);
  ++drive_;
}

std::optional<LineArchive::Place> LineArchive::nearest(MarkingType type, const Point& point,
                                                       const Eigen::Vector2d& along, double within_m) const {
  std::optional<Place> nearest;
  const auto consider = [&](const MeasuredPolyline& course, const auto& stddev_at) {
    const Projection foot = course.project(point, within_m);
    if (!foot.inside || foot.distance_m >= within_m || !geometry::same_level(foot.foot, point)) return;
    const Eigen::Vector2d direction = course.direction(foot);
    if (std::abs(direction.dot(along)) < kMinAlong) return;
    within_m = foot.distance_m;
    nearest = {foot.foot, direction, stddev_at(foot)};
  };
  if (type == MarkingType::stopline) {
    for (const StoplineArchive::Entry& entry : stoplines_.entries())
      consider(entry.course, [&](const Projection&) {
        return entry.marking.lateral_stddev_m.empty() ? kUnknownStddev_m
                                                      : entry.marking.lateral_stddev_m.front();
      });
    return nearest;
  }
  for (const std::size_t k : tiles_.near(point))
    if (lines_[k].type == type)
      consider(lines_[k].course,
               [&](const Projection& foot) { return lines_[k].vertices[foot.segment].stddev_m; });
  return nearest;
}

/// The lines of its type that the drives agree on, other than its own, on which a vertex lies.
std::size_t LineArchive::lines_at(const ArchivedVertex& vertex, const ArchivedLine& of,
                                  double longer_than_m) const {
  const auto lies_there = [&](std::size_t k) {
    const ArchivedLine& line = lines_[k];
    if (&line == &of || line.type != of.type || line.course.length() <= longer_than_m) return false;
    if (!line.box.contains(vertex.position.head<2>())) return false;
    const Projection foot = line.course.project(vertex.position, kSameLine_m);
    return foot.inside && foot.distance_m < kSameLine_m && line.vertices[foot.segment].votes.believed() &&
           geometry::same_level(foot.foot, vertex.position);
  };
  return static_cast<std::size_t>(std::ranges::count_if(tiles_.near(vertex.position), lies_there));
}

/// Whether more longer lines lie at a vertex than maps had beside it, on average.
bool LineArchive::is_covered(const ArchivedVertex& vertex, const ArchivedLine& of) const {
  const std::size_t longer = lines_at(vertex, of, of.course.length());
  return 2 * longer * vertex.maps >= 2 * vertex.beside + vertex.maps;
}

std::vector<bool> LineArchive::kept_vertices(const ArchivedLine& line) const {
  std::vector<bool> kept;
  for (const ArchivedVertex& vertex : line.vertices)
    kept.push_back(vertex.votes.believed() && !is_covered(vertex, line));
  return kept;
}

std::vector<Marking> LineArchive::markings() const {
  std::vector<Marking> markings;
  for (const ArchivedLine& line : lines_)
    std::ranges::move(line.markings(kept_vertices(line)), std::back_inserter(markings));
  for (const StoplineArchive::Entry& entry : stoplines_.entries())
    if (entry.votes.believed()) markings.push_back(entry.marking);
  std::erase_if(markings, is_doubtful);
  for (ElementId id = 0; Marking & marking : markings) marking.id = ++id;
  return markings;
}

std::vector<Change> LineArchive::changes() const {
  std::vector<Change> changes;
  for (const ArchivedLine& line : lines_) {
    const auto is_alone = [&](const ArchivedVertex& vertex) { return lines_at(vertex, line, 0.0) == 0; };
    append_changes(
        line, true, [&](const ArchivedVertex& v) { return is_gone(v.votes) && is_alone(v); }, changes);
    append_changes(
        line, false, [&](const ArchivedVertex& v) { return is_new(v.votes) && is_alone(v); }, changes);
  }
  for (const StoplineArchive::Entry& entry : stoplines_.entries()) {
    const bool gone = is_gone(entry.votes);
    if (gone || is_new(entry.votes))
      changes.push_back({.gone = gone,
                         .type = MarkingType::stopline,
                         .points = entry.marking.points,
                         .drive = gone ? entry.votes.last_drive : entry.votes.first_drive});
  }
  return changes;
}

}  // namespace laneloom::exports
