#include "mapping/voxels/vectorise.hpp"

#include <algorithm>
#include <cmath>

#include "laneloom/polyline.hpp"
#include "mapping/markings/markings.hpp"
#include "mapping/voxels/polyline_estimation.hpp"

namespace laneloom::voxels {
namespace {

std::vector<WeightedPoint> weighted_centers(const Instance& instance, const VoxelMap& map) {
  std::vector<WeightedPoint> points;
  points.reserve(instance.voxels.size());
  for (const VoxelId id : instance.voxels) {
    // A voxel whose detections are all forgotten still marks where the line was seen.
    points.push_back({map.center(map[id]), std::max(1.0, static_cast<double>(map[id].count(instance.type)))});
  }
  return points;
}

bool runs_backwards(const Polyline& line, const Polyline& before, const Eigen::Vector2d& forward) {
  if (before.size() < 2) return (line.back() - line.front()).head<2>().dot(forward) < 0.0;
  const MeasuredPolyline measured(before);
  return measured.project(line.back()).arc_m < measured.project(line.front()).arc_m;
}

double size_share(MarkingType type) { return type == MarkingType::stopline ? 0.5 : 1.0; }

}  // namespace

std::vector<StyleRange> estimate_styles(const Polyline& line, const std::vector<VoxelId>& voxels,
                                        const VoxelMap& map, const StyleConfig& config) {
  const MeasuredPolyline measured(line);
  const auto bins =
      static_cast<std::size_t>(std::max(1.0, std::ceil(measured.length() / config.bin_length_m)));
  const double bin_m = measured.length() / static_cast<double>(bins);
  std::vector<markings::StyleVotes> votes(bins);
  for (const VoxelId id : voxels) {
    const double arc_m = measured.project(map.center(map[id])).arc_m;
    auto& bin = votes[std::min(bins - 1, static_cast<std::size_t>(arc_m / bin_m))];
    for (std::size_t k = 0; k < kMarkingStyleCount; ++k) bin[k] += map[id].styles[k];
  }
  std::vector<StyleRange> styles;
  for (std::size_t k = 0; k < bins; ++k) {
    const auto bin = static_cast<double>(k);
    markings::append_style(styles, {{bin_m * bin, bin_m * (bin + 1.0)}, markings::voted(votes[k], config)});
  }
  return styles;
}

void update_polylines(const PolylineConfig& config, const StyleConfig& style_config, const VoxelMap& map,
                      const Eigen::Vector2d& forward, Instances& instances) {
  for (Instance& instance : instances.all()) {
    if (!instance.dirty) continue;
    instance.dirty = false;
    const Polyline before = std::move(instance.points);
    instance.points.clear();
    instance.styles.clear();
    if (static_cast<double>(instance.voxels.size()) < size_share(instance.type) * config.min_voxels) continue;
    Polyline line = estimate_polyline(weighted_centers(instance, map), instance.type, config);
    if (line.empty() || length(line) < size_share(instance.type) * config.min_length_m) continue;
    if (length(line) <= 0.0) continue;
    if (runs_backwards(line, before, forward)) std::ranges::reverse(line);
    instance.styles = estimate_styles(line, instance.voxels, map, style_config);
    instance.points = std::move(line);
  }
}

std::vector<Marking> markings_in_range(const geometry::MapBox& range, double min_length_m,
                                       Instances& instances, markings::IdSource& ids) {
  std::vector<Marking> markings;
  for (Instance& instance : instances.all()) {
    if (instance.points.empty()) continue;
    const Marking whole{.id = instance.id,
                        .type = instance.type,
                        .points = instance.points,
                        .styles = instance.styles,
                        .observations = instance.observations,
                        .first_seen_ns = instance.first_seen_ns};
    std::size_t count = 0;
    for (const Stretch& stretch : range.inside(instance.points)) {
      if (stretch.length() <= 0.0 || stretch.length() < size_share(instance.type) * min_length_m) continue;
      Marking part = markings::slice(whole, stretch);
      if (count > instance.extra_ids.size()) instance.extra_ids.push_back(ids.next());
      if (count > 0) part.id = instance.extra_ids[count - 1];
      ++count;
      markings.push_back(std::move(part));
    }
  }
  return markings;
}

}  // namespace laneloom::voxels
