#include "export/archived_line.hpp"

#include <algorithm>
#include <cmath>

namespace laneloom::exports {
namespace {

constexpr double kVertexStep_m = 1.0;  // between vertices
constexpr double kMinLength_m = 2.0;
constexpr double kRepeated_m = 0.05;  // vertices that are nearer are one
constexpr double kMinShare = 0.5;     // share of the votes that a style needs
constexpr std::size_t kBlink = 5;     // vertices; a line is whole where no more in a row are not kept

MarkingStyle style_at(const Marking& marking, double arc_m) {
  const auto after =
      std::ranges::find_if(marking.styles, [&](const StyleRange& part) { return arc_m < part.range.to_m; });
  if (after != marking.styles.end()) return after->style;
  return marking.styles.empty() ? MarkingStyle::unknown : marking.styles.back().style;
}

using Vertices = std::vector<ArchivedVertex>;

/// The runs of vertices that are kept. Short gaps between them are kept, too.
std::vector<Vertices> runs_of(const Vertices& vertices, const std::vector<bool>& kept) {
  std::vector<Vertices> runs;
  std::size_t end_before = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!kept[i]) continue;
    if (runs.empty() || i - end_before > kBlink) {
      runs.emplace_back();
      end_before = i;
    }
    for (; end_before <= i; ++end_before) runs.back().push_back(vertices[end_before]);
  }
  return runs;
}

Polyline points_of(const Vertices& vertices) {
  Polyline points;
  points.reserve(vertices.size());
  for (const ArchivedVertex& vertex : vertices) points.push_back(vertex.position);
  return points;
}

Marking marking_of(const Vertices& vertices) {
  Marking marking{.points = points_of(vertices)};
  const std::vector<double> arcs_m = arc_lengths(marking.points);
  double existence_sum = 0.0;
  std::ptrdiff_t confirmed = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const ArchivedVertex& vertex = vertices[i];
    marking.lateral_stddev_m.push_back(vertex.stddev_m);
    existence_sum += vertex.existence;
    confirmed += vertex.confirmed ? 1 : 0;
    if (i > 0)
      markings::append_style(marking.styles, {{arcs_m[i - 1], arcs_m[i]},
                                              markings::voted(vertex.styles, {.min_share = kMinShare})});
  }
  marking.existence_probability = existence_sum / static_cast<double>(vertices.size());
  marking.status = 2 * confirmed > std::ssize(vertices) ? ElementStatus::confirmed : ElementStatus::tentative;
  return marking;
}

}  // namespace

std::vector<ArchivedVertex> vertices_of(const ArchivedPiece& archived) {
  const Marking& piece = archived.marking;
  const MeasuredPolyline line(piece.points);
  const std::vector<double> arcs_m = arc_lengths(piece.points);
  const Polyline points = line.resample(kVertexStep_m);
  Vertices vertices;
  vertices.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m = line.length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
    ArchivedVertex& vertex = vertices.emplace_back();
    vertex.source = {archived.pass, piece.id};
    vertex.position = points[i];
    vertex.stddev_m = piece.lateral_stddev_m.empty()
                          ? kUnknownStddev_m
                          : std::max(0.01, markings::deviation_at(arcs_m, piece.lateral_stddev_m, arc_m));
    vertex.weight = 1.0 / (vertex.stddev_m * vertex.stddev_m);
    vertex.existence = piece.existence_probability;
    vertex.beside = archived.beside.size();
    vertex.confirmed = piece.status == ElementStatus::confirmed;
    vertex.styles[index(style_at(piece, arc_m))] = vertex.weight;
  }
  return vertices;
}

void ArchivedLine::measure() {
  const auto repeats = [](const ArchivedVertex& a, const ArchivedVertex& b) {
    return (a.position - b.position).head<2>().norm() < kRepeated_m;
  };
  vertices.erase(std::unique(vertices.begin(), vertices.end(), repeats), vertices.end());
  course = MeasuredPolyline(points_of(vertices));
  box.setEmpty();
  for (const ArchivedVertex& vertex : vertices) box.extend(vertex.position.head<2>());
  box = {box.min().array() - kSameLine_m, box.max().array() + kSameLine_m};
}

std::vector<Marking> ArchivedLine::markings(const std::vector<bool>& kept) const {
  std::vector<Marking> markings;
  for (const Vertices& run : runs_of(vertices, kept)) {
    Marking marking = marking_of(run);
    if (length(marking.points) < kMinLength_m) continue;
    marking.type = type;
    marking.observations = observations;
    marking.first_seen_ns = first_seen_ns;
    marking.last_seen_ns = last_seen_ns;
    markings.push_back(std::move(marking));
  }
  return markings;
}

}  // namespace laneloom::exports
