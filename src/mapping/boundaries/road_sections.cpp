#include "mapping/boundaries/road_sections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mapping/geometry/levels.hpp"
#include "mapping/geometry/oriented_groups.hpp"

namespace laneloom {
namespace {

constexpr double kSampleStep_m = 2.0;  // half of the shortest lane
constexpr double kAlignedCosine =
    0.2;  // with the heading: below, a road crosses the vehicle's rather than follows it

/// A boundary's points, evenly spaced, with the directions in which it leaves them.
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

/// How `b` lies beside `a`; empty where no point of `a` has its foot inside of `b`, near and in a similar
/// direction.
std::optional<SideBySide> side_by_side(const Samples& a, const MeasuredPolyline& b,
                                       const SectionConfig& config) {
  const double min_cosine = cos_degrees(config.max_angle_deg);
  double lateral_sum_m = 0.0, cosine_sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Projection foot = b.project(a.points[i], config.max_distance_m);
    if (!foot.inside || !same_level(foot.foot, a.points[i])) continue;
    const double cosine = a.directions[i].dot(b.direction(foot));
    if (std::abs(cosine) < min_cosine) continue;
    lateral_sum_m += foot.lateral_m;
    cosine_sum += cosine;
    ++count;
  }
  if (count == 0) return std::nullopt;
  const bool opposed = cosine_sum < 0.0;
  const double lateral_m = lateral_sum_m / count;  // of `a`, as `b` runs
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

using Graph = std::vector<std::vector<SideBySide>>;

Graph side_by_side(const std::vector<MeasuredPolyline>& lines, const SectionConfig& config) {
  std::vector<Samples> samples;
  samples.reserve(lines.size());
  for (const MeasuredPolyline& line : lines) samples.push_back(sample(line));
  Graph graph(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const bool i_is_longer = lines[i].length() >= lines[j].length();
      const std::size_t longer = i_is_longer ? i : j, shorter = i_is_longer ? j : i;
      auto beside = side_by_side(samples[shorter], lines[longer], config);
      if (!beside) continue;
      beside->other = longer;
      graph[shorter].push_back(*beside);
      graph[longer].push_back(seen_from_other(*beside, shorter));
    }
  }
  return graph;
}

/// Cosine between a line and the vehicle's heading, where the line passes it.
double along_heading(const MeasuredPolyline& line, const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
  return line.direction(line.project(T_map_body.translation())).dot(heading) / heading.norm();
}

/// What is nearer to the vehicle is joined first.
OrientedGroups join_sections(const Graph& graph, const std::vector<double>& distance_m) {
  struct Pair {
    std::size_t a, b;
    bool opposed;
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < graph.size(); ++a)
    for (const SideBySide& beside : graph[a])
      if (a < beside.other) pairs.push_back({a, beside.other, beside.opposed});
  std::ranges::stable_sort(pairs, {},
                           [&](const Pair& p) { return std::max(distance_m[p.a], distance_m[p.b]); });
  OrientedGroups sections(graph.size());
  for (const auto& [a, b, opposed] : pairs) sections.join(a, b, opposed);
  return sections;
}

/// Whether a section runs against the vehicle in the direction of one of its boundaries. All have a say, by
/// their lengths, as one alone may turn off into another road.
bool against_heading(const std::vector<std::size_t>& section, std::size_t boundary,
                     const std::vector<MeasuredPolyline>& measured, const OrientedGroups& sections,
                     const Eigen::Isometry3d& T_map_body) {
  double sum_m = 0.0, total_m = 0.0;
  for (const std::size_t k : section) {
    const double length_m = measured[k].length();
    const double sense = sections.opposed(k, boundary) ? -1.0 : 1.0;
    sum_m += sense * length_m * along_heading(measured[k], T_map_body);
    total_m += length_m;
  }
  return sum_m < -kAlignedCosine * total_m;
}

}  // namespace

SectionGraph road_sections(const SectionConfig& config, const Eigen::Isometry3d& T_map_body,
                           std::vector<LaneBoundary>& boundaries, std::vector<MeasuredPolyline>& measured) {
  SectionGraph result{.sections = {}, .beside = side_by_side(measured, config)};
  std::vector<double> distance_m;
  distance_m.reserve(measured.size());
  for (const MeasuredPolyline& line : measured)
    distance_m.push_back(line.project(T_map_body.translation()).distance_m);
  const OrientedGroups sections = join_sections(result.beside, distance_m);
  std::vector<bool> turned(boundaries.size(), false);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    if (sections.group(i) != i) continue;
    RoadSection section;
    for (std::size_t k = i; k < boundaries.size(); ++k)
      if (sections.group(k) == i) section.boundaries.push_back(k);
    const std::size_t longest = *std::ranges::max_element(
        section.boundaries, {}, [&](std::size_t k) { return measured[k].length(); });
    const bool turn_longest = against_heading(section.boundaries, longest, measured, sections, T_map_body);
    for (const std::size_t k : section.boundaries) {
      turned[k] = sections.opposed(k, longest) != turn_longest;
      if (!turned[k]) continue;
      reverse(boundaries[k]);
      measured[k] = MeasuredPolyline(boundaries[k].marking.points);
    }
    result.sections.push_back(std::move(section));
  }
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    for (SideBySide& beside : result.beside[i]) {
      if (turned[i]) beside.lateral_m = -beside.lateral_m;
      beside.opposed = beside.opposed != (turned[i] != turned[beside.other]);
    }
    std::ranges::stable_sort(result.beside[i], {},
                             [](const SideBySide& beside) { return std::abs(beside.lateral_m); });
  }
  return result;
}

}  // namespace laneloom
