#include "mapping/geometry/map_box.hpp"

#include <optional>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/clip_segment.hpp"

namespace laneloom::geometry {

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
    const std::optional<SegmentPart> part = clip_segment(previous, current, box_);
    previous = current;
    if (!part) continue;
    const double segment_m = arc[i] - arc[i - 1];
    const Stretch stretch{arc[i - 1] + part->from * segment_m, arc[i - 1] + part->to * segment_m};
    const bool continues = part->from == 0.0 && !stretches.empty() && stretches.back().to_m == arc[i - 1];
    if (continues) {
      stretches.back().to_m = stretch.to_m;
    } else {
      stretches.push_back(stretch);
    }
  }
  return stretches;
}

}  // namespace laneloom::geometry
