#include "mapping/road_sections.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mapping/markings.hpp"

namespace laneloom {
namespace {

constexpr double kSampleStep_m = 4.0;  // the length of a lane, at least
constexpr double kAlignedCosine =
    0.2;  // with the heading: below, a road crosses the vehicle's rather than follows it

/// How `a` lies to `b` over the part of `a` that is beside `b`.
struct Overlap {
  double lateral_m = 0.0;  ///< mean; positive: a is left of b, as b runs
  double length_m = 0.0;
  bool opposed = false;  ///< a and b run against each other
};

/// How `b` then lies to `a`.
Overlap seen_from_other(const Overlap& overlap) {
  return {.lateral_m = overlap.opposed ? overlap.lateral_m : -overlap.lateral_m,
          .length_m = overlap.length_m,
          .opposed = overlap.opposed};
}

/// A boundary's points, evenly spaced, with the directions in which it leaves them.
struct Samples {
  Polyline points;
  std::vector<Eigen::Vector2d> directions;
};

Samples sample(const MeasuredPolyline& line) {
  Samples samples{line.resample(kSampleStep_m), {}};
  samples.directions.reserve(samples.points.size());
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const std::size_t k = std::min(i, samples.points.size() - 2);
    samples.directions.push_back((samples.points[k + 1] - samples.points[k]).head<2>().normalized());
  }
  return samples;
}

/// Empty where no point of `a` has its foot inside of `b`, near and in a similar direction.
std::optional<Overlap> overlap(const Samples& a, const MeasuredPolyline& b, double max_distance_m,
                               double min_cosine) {
  double lateral_sum_m = 0.0, cosine_sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Projection foot = b.project(a.points[i], max_distance_m);
    if (!foot.inside) continue;
    const double cosine = a.directions[i].dot(b.direction(foot));
    if (std::abs(cosine) < min_cosine) continue;
    lateral_sum_m += foot.lateral_m;
    cosine_sum += cosine;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Overlap{lateral_sum_m / count, count * kSampleStep_m, cosine_sum < 0.0};
}

struct Edge {
  std::size_t to = 0;
  Overlap overlap;  ///< of `to` beside the vertex
};
using Graph = std::vector<std::vector<Edge>>;

Graph overlap_graph(const std::vector<MeasuredPolyline>& lines, const SectionConfig& config) {
  const double min_cosine = cos_degrees(config.max_angle_deg);
  std::vector<Samples> samples;
  samples.reserve(lines.size());
  for (const MeasuredPolyline& line : lines) samples.push_back(sample(line));
  Graph graph(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const bool i_is_longer = lines[i].length() >= lines[j].length();
      const std::size_t longer = i_is_longer ? i : j, shorter = i_is_longer ? j : i;
      const auto beside = overlap(samples[shorter], lines[longer], config.max_distance_m, min_cosine);
      if (!beside) continue;
      graph[longer].push_back({shorter, *beside});
      graph[shorter].push_back({longer, seen_from_other(*beside)});
    }
  }
  return graph;
}

/// Cosine between a line and the vehicle's heading, where the line passes it.
double along_heading(const MeasuredPolyline& line, const Eigen::Isometry3d& T_map_body) {
  const Eigen::Vector2d heading = T_map_body.linear().col(0).head<2>();
  return line.direction(line.project(T_map_body.translation())).dot(heading) / heading.norm();
}

/// Whether a section runs against the vehicle in the direction of one of its boundaries. All have a say, by
/// their lengths, as one alone may turn off into another road. `opposed` compares them with each other.
bool against_heading(const std::vector<std::size_t>& section, std::size_t boundary,
                     const std::vector<MeasuredPolyline>& measured,
                     const std::vector<std::optional<bool>>& opposed, const Eigen::Isometry3d& T_map_body) {
  double sum_m = 0.0, total_m = 0.0;
  for (const std::size_t k : section) {
    const double length_m = measured[k].length();
    const double sense = *opposed[k] == *opposed[boundary] ? 1.0 : -1.0;
    sum_m += sense * length_m * along_heading(measured[k], T_map_body);
    total_m += length_m;
  }
  return sum_m < -kAlignedCosine * total_m;
}

/// Depth-first search from `start`; says for every boundary that it reaches whether it runs against `start`.
void visit(const Graph& graph, std::size_t start, std::vector<std::optional<bool>>& opposed,
           std::vector<std::size_t>& members) {
  std::vector<std::size_t> stack{start};
  opposed[start] = false;
  while (!stack.empty()) {
    const std::size_t current = stack.back();
    stack.pop_back();
    members.push_back(current);
    for (const Edge& edge : graph[current]) {
      if (opposed[edge.to]) continue;
      opposed[edge.to] = *opposed[current] != edge.overlap.opposed;
      stack.push_back(edge.to);
    }
  }
  std::ranges::sort(members);
}

}  // namespace

SectionGraph road_sections(const SectionConfig& config, const Eigen::Isometry3d& T_map_body,
                           std::vector<LaneBoundary>& boundaries, std::vector<MeasuredPolyline>& measured) {
  const Graph graph = overlap_graph(measured, config);
  SectionGraph result;
  std::vector<std::optional<bool>> opposed(boundaries.size());
  std::vector<bool> turned(boundaries.size(), false);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    if (opposed[i]) continue;
    RoadSection section;
    visit(graph, i, opposed, section.boundaries);
    const std::size_t longest = *std::ranges::max_element(
        section.boundaries, {}, [&](std::size_t k) { return measured[k].length(); });
    const bool turn_longest = against_heading(section.boundaries, longest, measured, opposed, T_map_body);
    for (const std::size_t k : section.boundaries) {
      turned[k] = (*opposed[k] != *opposed[longest]) != turn_longest;
      if (!turned[k]) continue;
      reverse(boundaries[k]);
      measured[k] = MeasuredPolyline(boundaries[k].marking.points);
    }
    result.sections.push_back(std::move(section));
  }

  result.right_of.resize(boundaries.size());
  for (std::size_t i = 0; i < graph.size(); ++i) {
    for (const Edge& edge : graph[i]) {
      const double lateral_m = turned[i] ? -edge.overlap.lateral_m : edge.overlap.lateral_m;
      if (lateral_m < 0.0) result.right_of[i].push_back({edge.to, -lateral_m, edge.overlap.length_m});
    }
    std::ranges::stable_sort(result.right_of[i], {}, &SideBySide::distance_m);
  }
  return result;
}

}  // namespace laneloom
