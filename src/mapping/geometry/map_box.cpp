#include "mapping/geometry/map_box.hpp"

#include <algorithm>
#include <optional>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

/// The part of the segment a..b that lies in the box, as shares of the segment (Liang and Barsky's clipping).
std::optional<Stretch> clip(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                            const Eigen::AlignedBox2d& box) {
  double from = 0.0, to = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double delta = b[axis] - a[axis];
    if (delta == 0.0) {
      if (a[axis] < box.min()[axis] || a[axis] > box.max()[axis]) return std::nullopt;
      continue;
    }
    const double at_min = (box.min()[axis] - a[axis]) / delta;
    const double at_max = (box.max()[axis] - a[axis]) / delta;
    from = std::max(from, std::min(at_min, at_max));
    to = std::min(to, std::max(at_min, at_max));
  }
  if (from >= to) return std::nullopt;
  return Stretch{from, to};
}

}  // namespace

MapBox::MapBox(const RangeConfig& config, const Eigen::Isometry3d& T_map_body)
    : T_map_body_(T_map_body),
      T_body_map_(T_map_body.inverse()),
      box_(Eigen::Vector2d(config.forward_min_m, -config.side_max_m),
           Eigen::Vector2d(config.forward_max_m, config.side_max_m)) {
  const Eigen::Vector2d margin(config.margin_forward_m, config.margin_side_m);
  kept_ = Eigen::AlignedBox2d(box_.min() - margin, box_.max() + margin);
}

bool MapBox::keeps(const Point& point_map) const {
  return kept_.contains((T_body_map_ * point_map).head<2>());
}

bool MapBox::shows(const Point& point_map) const {
  return box_.contains((T_body_map_ * point_map).head<2>());
}

std::vector<Stretch> MapBox::inside(const Polyline& line_map) const {
  std::vector<Stretch> stretches;
  const std::vector<double> arc = arc_lengths(line_map);
  Eigen::Vector2d previous = (T_body_map_ * line_map.front()).head<2>();
  for (std::size_t i = 1; i < line_map.size(); ++i) {
    const Eigen::Vector2d current = (T_body_map_ * line_map[i]).head<2>();
    const std::optional<Stretch> part = clip(previous, current, box_);
    previous = current;
    if (!part) continue;
    const double segment_m = arc[i] - arc[i - 1];
    const Stretch stretch{arc[i - 1] + part->from_m * segment_m, arc[i - 1] + part->to_m * segment_m};
    const bool continues = part->from_m == 0.0 && !stretches.empty() && stretches.back().to_m == arc[i - 1];
    if (continues) {
      stretches.back().to_m = stretch.to_m;
    } else {
      stretches.push_back(stretch);
    }
  }
  return stretches;
}

}  // namespace laneloom
