#include "mapping/road_sections.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "mapping/markings.hpp"

namespace laneloom {
namespace {

constexpr double kSampleStep_m = 2.0;  // half of the shortest lane
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

/// Boundaries that run side by side, and whether they run against each other. Round the corners of an
/// intersection that may have no answer: then what is nearest to the vehicle decides, and furthest off a lane
/// is lost.
class Sections {
 public:
  Sections(const Graph& graph, const std::vector<double>& distance_m)
      : section_(graph.size()), opposed_(graph.size(), false) {
    std::iota(section_.begin(), section_.end(), 0U);
    struct Pair {
      std::size_t a, b;
      Overlap overlap;
    };
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < graph.size(); ++a)
      for (const Edge& edge : graph[a])
        if (a < edge.to) pairs.push_back({a, edge.to, edge.overlap});
    std::ranges::stable_sort(pairs, {},
                             [&](const Pair& p) { return std::max(distance_m[p.a], distance_m[p.b]); });
    for (const auto& [a, b, overlap] : pairs)
      if (section_[a] != section_[b]) join(a, b, overlap.opposed);
  }
  /// The smallest index of its members.
  std::size_t section(std::size_t boundary) const { return section_[boundary]; }
  bool opposed(std::size_t a, std::size_t b) const { return opposed_[a] != opposed_[b]; }

 private:
  void join(std::size_t a, std::size_t b, bool opposed) {
    const bool turn = opposed_[a] != (opposed_[b] != opposed);
    const auto [kept, gone] = std::minmax({section_[a], section_[b]});
    for (std::size_t k = 0; k < section_.size(); ++k) {
      if (section_[k] != gone) continue;
      section_[k] = kept;
      opposed_[k] = opposed_[k] != turn;
    }
  }

  std::vector<std::size_t> section_;
  std::vector<bool> opposed_;  ///< to the other members, as a whole either way
};

/// Whether a section runs against the vehicle in the direction of one of its boundaries. All have a say, by
/// their lengths, as one alone may turn off into another road.
bool against_heading(const std::vector<std::size_t>& section, std::size_t boundary,
                     const std::vector<MeasuredPolyline>& measured, const Sections& sections,
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
  const Graph graph = overlap_graph(measured, config);
  std::vector<double> distance_m;
  distance_m.reserve(measured.size());
  for (const MeasuredPolyline& line : measured)
    distance_m.push_back(line.project(T_map_body.translation()).distance_m);
  const Sections sections(graph, distance_m);
  SectionGraph result;
  std::vector<bool> turned(boundaries.size(), false);
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    if (sections.section(i) != i) continue;
    RoadSection section;
    for (std::size_t k = i; k < boundaries.size(); ++k)
      if (sections.section(k) == i) section.boundaries.push_back(k);
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
