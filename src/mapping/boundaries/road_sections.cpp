#include "mapping/boundaries/road_sections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/oriented_groups.hpp"

namespace laneloom::boundaries {
namespace {

constexpr double kSampleStep_m = 2.0;  // half of the shortest lane
constexpr double kAlignedCosine =
    0.2;  // with the vehicle's heading; a road with less crosses the vehicle's way

/// Evenly spaced points of a boundary, and its direction behind each of them.
struct Samples {
  Polyline points;
  std::vector<Eigen::Vector2d> directions;
  double length_m;
};

Samples sample(const MeasuredPolyline& line) {
  Samples samples{line.resample(kSampleStep_m), {}, line.length()};
  samples.directions.reserve(samples.points.size());
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const std::size_t k = std::min(i, samples.points.size() - 2);
    samples.directions.push_back((samples.points[k + 1] - samples.points[k]).head<2>().normalized());
  }
  return samples;
}

/// How `b` lies beside `a`. Empty: no point of `a` has a foot inside `b` that is near and where the two run
/// in a similar direction.
std::optional<SideBySide> side_by_side(const Samples& a, const MeasuredPolyline& b,
                                       const SectionConfig& config) {
  const double min_cosine = cos_degrees(config.max_angle_deg);
  double lateral_sum_m = 0.0, cosine_sum = 0.0;
  int count = 0;
  MeasuredPolyline::Cursor along_b(b);
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Projection foot = along_b.project(a.points[i], config.max_distance_m);
    if (!foot.inside || !geometry::same_level(foot.foot, a.points[i])) continue;
    const double cosine = a.directions[i].dot(b.direction(foot));
    if (std::abs(cosine) < min_cosine) continue;
    lateral_sum_m += foot.lateral_m;
    cosine_sum += cosine;
    ++count;
  }
  if (count == 0) return std::nullopt;
  const bool opposed = cosine_sum < 0.0;
  const double lateral_m = lateral_sum_m / count;  // of `a`, positive on the left of `b`
  return SideBySide{.lateral_m = opposed ? lateral_m : -lateral_m,
                    .length_m = a.length_m * count / static_cast<double>(a.points.size()),
                    .opposed = opposed};
}

SideBySide seen_from_other(const SideBySide& beside, std::size_t self) {
  return {.other = self,
          .lateral_m = beside.opposed ? beside.lateral_m : -beside.lateral_m,
          .length_m = beside.length_m,
          .opposed = beside.opposed};
}

std::vector<std::vector<SideBySide>> side_by_side(const Boundaries& boundaries, const SectionConfig& config) {
  std::vector<Samples> samples;
  samples.reserve(boundaries.size());
  for (const LaneBoundary& boundary : boundaries) samples.push_back(sample(boundary.course));
  std::vector<std::vector<SideBySide>> pairs(boundaries.size());
  for (std::vector<SideBySide>& beside_one : pairs) beside_one.reserve(boundaries.size() - 1);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    for (std::size_t j = i + 1; j < boundaries.size(); ++j) {
      const bool i_is_longer = samples[i].length_m >= samples[j].length_m;
      const std::size_t longer = i_is_longer ? i : j, shorter = i_is_longer ? j : i;
      auto beside = side_by_side(samples[shorter], boundaries[longer].course, config);
      if (!beside) continue;
      beside->other = longer;
      pairs[shorter].push_back(*beside);
      pairs[longer].push_back(seen_from_other(*beside, shorter));
    }
  }
  return pairs;
}

/// Cosine between a line and the vehicle's heading, where the line passes it.
double along_heading(const MeasuredPolyline& line, const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
  return line.direction(line.project(T_map_body.translation())).dot(heading) / heading.norm();
}

/// Joins boundaries that overlap, those nearest to the vehicle first.
geometry::OrientedGroups join_sections(const SectionGraph& graph, const Point& vehicle) {
  struct Pair {
    std::size_t a, b;
    bool opposed;
  };
  std::vector<double> distance_m;
  distance_m.reserve(graph.boundaries.size());
  for (const LaneBoundary& boundary : graph.boundaries)
    distance_m.push_back(boundary.course.project(vehicle).distance_m);
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < graph.beside.size(); ++a)
    for (const SideBySide& beside : graph.beside[a])
      if (a < beside.other) pairs.push_back({a, beside.other, beside.opposed});
  std::ranges::stable_sort(pairs, {},
                           [&](const Pair& p) { return std::max(distance_m[p.a], distance_m[p.b]); });
  geometry::OrientedGroups groups(graph.boundaries.size());
  for (const auto& [a, b, opposed] : pairs) groups.join(a, b, opposed);
  return groups;
}

std::vector<RoadSection> sections_of(const geometry::OrientedGroups& groups, std::size_t count) {
  std::vector<RoadSection> sections;
  for (std::size_t i = 0; i < count; ++i) {
    if (groups.group(i) != i) continue;
    RoadSection& section = sections.emplace_back();
    for (std::size_t k = i; k < count; ++k)
      if (groups.group(k) == i) section.boundaries.push_back(k);
  }
  return sections;
}

/// Whether a section runs against the vehicle, if it is given the direction of `boundary`. All boundaries
/// have a say, weighted by length, since a single one may turn off into another road.
bool against_heading(const RoadSection& section, std::size_t boundary, const Boundaries& boundaries,
                     const geometry::OrientedGroups& groups, const Eigen::Isometry3d& T_map_body) {
  double sum_m = 0.0, total_m = 0.0;
  for (const std::size_t k : section.boundaries) {
    const MeasuredPolyline& course = boundaries[k].course;
    const double length_m = course.length();
    const double sense = groups.opposed(k, boundary) ? -1.0 : 1.0;
    sum_m += sense * length_m * along_heading(course, T_map_body);
    total_m += length_m;
  }
  return sum_m < -kAlignedCosine * total_m;
}

/// Per boundary, whether it has to be turned to run as its section does.
std::vector<bool> wrong_ways(const SectionGraph& graph, const geometry::OrientedGroups& groups,
                             const Eigen::Isometry3d& T_map_body) {
  std::vector<bool> wrong(graph.boundaries.size(), false);
  for (const RoadSection& section : graph.sections) {
    const std::size_t longest = *std::ranges::max_element(
        section.boundaries, {}, [&](std::size_t k) { return graph.boundaries[k].course.length(); });
    const bool turn_longest = against_heading(section, longest, graph.boundaries, groups, T_map_body);
    for (const std::size_t k : section.boundaries) wrong[k] = groups.opposed(k, longest) != turn_longest;
  }
  return wrong;
}

void turn(const std::vector<bool>& turned, SectionGraph& graph) {
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (turned[i]) graph.boundaries.reverse(i);
    for (SideBySide& beside : graph.beside[i]) {
      if (turned[i]) beside.lateral_m = -beside.lateral_m;
      beside.opposed = beside.opposed != (turned[i] != turned[beside.other]);
    }
  }
}

}  // namespace

SectionGraph road_sections(Boundaries boundaries, const Eigen::Isometry3d& T_map_body,
                           const SectionConfig& config) {
  auto beside = side_by_side(boundaries, config);
  SectionGraph graph{.boundaries = std::move(boundaries), .sections = {}, .beside = std::move(beside)};
  const geometry::OrientedGroups groups = join_sections(graph, T_map_body.translation());
  graph.sections = sections_of(groups, graph.boundaries.size());
  turn(wrong_ways(graph, groups, T_map_body), graph);
  for (std::vector<SideBySide>& beside_one : graph.beside)
    std::ranges::stable_sort(beside_one, {},
                             [](const SideBySide& other) { return std::abs(other.lateral_m); });
  return graph;
}

}  // namespace laneloom::boundaries
