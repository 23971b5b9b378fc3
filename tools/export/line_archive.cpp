#include "export/line_archive.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "mapping/geometry/levels.hpp"

namespace laneloom::exports {
namespace {

constexpr double kVertexStep_m = 1.0;  // between vertices
constexpr double kMinAlong = 0.9;      // cosine between a piece and the line that it lies along
constexpr double kAtEnd_m = 1.5;       // a match that is nearer to the line's end leads beyond it
constexpr double kMinLength_m = 2.0;
constexpr double kShadow = 0.8;       // share of a shadow that lies along another line
constexpr double kRepeated_m = 0.05;  // vertices that are nearer are one
constexpr std::uint64_t kMinObservations = 15;
constexpr double kMinExistence = 0.7;
constexpr double kUnknownStddev_m = 0.3;
constexpr double kMinShare = 0.5;  // share of the votes that a style needs

Eigen::AlignedBox2d box_of(const Polyline& points, double margin_m) {
  Eigen::AlignedBox2d box;
  for (const Point& point : points) box.extend(point.head<2>());
  return {box.min().array() - margin_m, box.max().array() + margin_m};
}

MarkingStyle style_at(const Marking& marking, double arc_m) {
  const auto after =
      std::ranges::find_if(marking.styles, [&](const StyleRange& part) { return arc_m < part.range.to_m; });
  if (after != marking.styles.end()) return after->style;
  return marking.styles.empty() ? MarkingStyle::unknown : marking.styles.back().style;
}

/// Whether a marking was seen as seldom, or is believed in as little, as lines that are not there sometimes
/// are.
bool is_doubtful(const Marking& marking) {
  const double existence = marking.existence_probability;
  return (existence >= 0.0 && existence < kMinExistence) || marking.status == ElementStatus::tentative ||
         marking.observations < kMinObservations;
}

}  // namespace

LineArchive::Vertices LineArchive::vertices_of(const ArchivedPiece& archived) {
  const Marking& piece = archived.marking;
  const MeasuredPolyline line(piece.points);
  const std::vector<double> arcs_m = arc_lengths(piece.points);
  const Polyline points = line.resample(kVertexStep_m);
  Vertices vertices;
  vertices.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m = line.length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
    Vertex& vertex = vertices.emplace_back();
    vertex.source = {archived.pass, piece.id};
    vertex.position = points[i];
    vertex.stddev_m = piece.lateral_stddev_m.empty()
                          ? kUnknownStddev_m
                          : std::max(0.01, markings::deviation_at(arcs_m, piece.lateral_stddev_m, arc_m));
    vertex.weight = 1.0 / (vertex.stddev_m * vertex.stddev_m);
    vertex.existence = piece.existence_probability;
    vertex.as_double = archived.beside.empty() ? -1 : 1;
    vertex.confirmed = piece.status == ElementStatus::confirmed;
    vertex.styles[index(style_at(piece, arc_m))] = vertex.weight;
  }
  return vertices;
}

void LineArchive::measure(Line& line) {
  const auto repeats = [](const Vertex& a, const Vertex& b) {
    return (a.position - b.position).head<2>().norm() < kRepeated_m;
  };
  line.vertices.erase(std::unique(line.vertices.begin(), line.vertices.end(), repeats), line.vertices.end());
  Polyline points;
  points.reserve(line.vertices.size());
  for (const Vertex& vertex : line.vertices) points.push_back(vertex.position);
  line.course = MeasuredPolyline(points);
  line.box = box_of(points, kSameLine_m);
}

std::vector<LineArchive::Match> LineArchive::match(const ArchivedPiece& piece,
                                                   const Vertices& vertices) const {
  std::vector<Match> matches(vertices.size(), Match{.line = kNoLine});
  std::vector<double> nearest_m(vertices.size(), kSameLine_m);
  const auto is_another = [&](const Source& source) {
    return source.first == piece.pass && std::ranges::find(piece.beside, source.second) != piece.beside.end();
  };
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const Line& line = lines_[k];
    if (line.type != piece.marking.type) continue;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Point& point = vertices[i].position;
      if (!line.box.contains(point.head<2>())) continue;
      const Projection foot = line.course.project(point, kSameLine_m);
      if (!foot.inside || foot.distance_m >= kSameLine_m || !geometry::same_level(foot.foot, point)) continue;
      const Source& source = line.vertices[foot.segment].source;
      const double distance_m = source == vertices[i].source ? 0.0 : foot.distance_m;
      if (distance_m >= nearest_m[i] || is_another(source)) continue;
      const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, vertices.size() - 1);
      const Eigen::Vector2d along = (vertices[after].position - vertices[before].position).head<2>();
      if (std::abs(line.course.direction(foot).dot(along)) < kMinAlong * along.norm()) continue;
      nearest_m[i] = distance_m;
      matches[i] = {k, foot.arc_m};
    }
  }
  return matches;
}

void LineArchive::fuse(const Vertices& piece, Line& line) {
  Polyline points;
  for (const Vertex& vertex : piece) points.push_back(vertex.position);
  const MeasuredPolyline course(points);
  const Eigen::AlignedBox2d box = box_of(points, kSameLine_m);
  for (Vertex& vertex : line.vertices) {
    if (!box.contains(vertex.position.head<2>())) continue;
    const Projection foot = course.project(vertex.position, kSameLine_m);
    if (!foot.inside || foot.distance_m >= kSameLine_m || !geometry::same_level(foot.foot, vertex.position))
      continue;
    const Vertex& seen = piece[std::min(foot.segment, piece.size() - 1)];
    vertex.position += seen.weight / (seen.weight + vertex.weight) * (foot.foot - vertex.position);
    vertex.source = seen.source;
    vertex.as_double += seen.as_double;
    vertex.weight += seen.weight;
    vertex.stddev_m = std::min(vertex.stddev_m, seen.stddev_m);
    vertex.existence = std::max(vertex.existence, seen.existence);
    vertex.confirmed = vertex.confirmed || seen.confirmed;
    for (std::size_t style = 0; style < kMarkingStyleCount; ++style)
      vertex.styles[style] += seen.styles[style];
  }
  measure(line);
}

bool LineArchive::extend(const Match& beside, const Vertices& beyond) {
  Line& line = lines_[beside.line];
  const bool at_back = line.course.length() - beside.arc_m <= kAtEnd_m;
  if (!at_back && beside.arc_m > kAtEnd_m) return false;
  const Point& end = at_back ? line.vertices.back().position : line.vertices.front().position;
  const Eigen::Vector2d leaving = end_direction(line.course.points(), at_back ? End::back : End::front);
  Vertices added = beyond;
  std::erase_if(added, [&](const Vertex& vertex) {
    const Eigen::Vector2d from_end = (vertex.position - end).head<2>();
    return from_end.norm() < 2.0 * kVertexStep_m && from_end.dot(leaving) < 0.3 * kVertexStep_m;
  });
  if (added.empty()) return true;
  line.vertices.insert(at_back ? line.vertices.end() : line.vertices.begin(), added.begin(), added.end());
  if (!at_back) std::reverse(line.vertices.begin(), line.vertices.begin() + std::ssize(added));
  measure(line);
  return true;
}

void LineArchive::credit(const ArchivedPiece& piece, Line& line) {
  const Marking& marking = piece.marking;
  const bool is_new = line.observations == 0;
  line.observations = std::max(line.observations, marking.observations);
  line.first_seen_ns = is_new ? marking.first_seen_ns : std::min(line.first_seen_ns, marking.first_seen_ns);
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
    const bool grown = begin > 0 && extend(matches[begin - 1], run);
    Vertices backwards(run.rbegin(), run.rend());
    if (!grown && !(end < vertices.size() && extend(matches[end], backwards)) && run.size() > 1) {
      Line& line = lines_.emplace_back();
      line.type = piece.marking.type;
      line.vertices = std::move(run);
      credit(piece, line);
      measure(line);
    }
  }
}

void LineArchive::add(const ArchivedPiece& piece) {
  if (piece.marking.type == MarkingType::stopline) return stoplines_.add(piece.marking);
  if (!(length(piece.marking.points) > 0.0)) return;
  const Vertices vertices = vertices_of(piece);
  const std::vector<Match> matches = match(piece, vertices);
  std::set<std::size_t> matched;
  for (const Match& match : matches)
    if (match.line != kNoLine) matched.insert(match.line);
  for (const std::size_t k : matched) {
    fuse(vertices, lines_[k]);
    credit(piece, lines_[k]);
  }
  add_unmatched(piece, vertices, matches);
}

Marking LineArchive::marking_of(const Line& line) {
  Marking marking{.type = line.type, .points = line.course.points()};
  const std::vector<double> arcs_m = arc_lengths(marking.points);
  double existence_sum = 0.0;
  std::ptrdiff_t confirmed = 0;
  for (std::size_t i = 0; i < line.vertices.size(); ++i) {
    const Vertex& vertex = line.vertices[i];
    marking.lateral_stddev_m.push_back(vertex.stddev_m);
    existence_sum += vertex.existence;
    confirmed += vertex.confirmed ? 1 : 0;
    if (i > 0)
      markings::append_style(marking.styles, {{arcs_m[i - 1], arcs_m[i]},
                                              markings::voted(vertex.styles, {.min_share = kMinShare})});
  }
  const auto count = static_cast<double>(line.vertices.size());
  marking.existence_probability = existence_sum / count;
  marking.status =
      2 * confirmed > std::ssize(line.vertices) ? ElementStatus::confirmed : ElementStatus::tentative;
  marking.observations = line.observations;
  marking.first_seen_ns = line.first_seen_ns;
  marking.last_seen_ns = line.last_seen_ns;
  return marking;
}

/// The lines that lie along longer ones, and that no map had beside those.
std::vector<std::size_t> LineArchive::shadows() const {
  std::vector<std::size_t> shadows;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const auto is_covered = [&](const Vertex& vertex) {
      return vertex.as_double <= 0 && std::ranges::any_of(lines_, [&](const Line& line) {
               if (line.type != lines_[i].type || line.course.length() <= lines_[i].course.length())
                 return false;
               if (!line.box.contains(vertex.position.head<2>())) return false;
               const Projection foot = line.course.project(vertex.position, kSameLine_m);
               return foot.inside && foot.distance_m < kSameLine_m &&
                      geometry::same_level(foot.foot, vertex.position);
             });
    };
    const auto covered = std::ranges::count_if(lines_[i].vertices, is_covered);
    if (static_cast<double>(covered) > kShadow * static_cast<double>(lines_[i].vertices.size()))
      shadows.push_back(i);
  }
  return shadows;
}

std::vector<Marking> LineArchive::markings() const {
  const std::vector<std::size_t> left_out = shadows();
  std::vector<Marking> markings;
  for (std::size_t i = 0; i < lines_.size(); ++i)
    if (lines_[i].course.length() >= kMinLength_m && std::ranges::count(left_out, i) == 0)
      markings.push_back(marking_of(lines_[i]));
  std::ranges::copy(stoplines_.markings(), std::back_inserter(markings));
  std::erase_if(markings, is_doubtful);
  for (ElementId id = 0; Marking & marking : markings) marking.id = ++id;
  return markings;
}

}  // namespace laneloom::exports
