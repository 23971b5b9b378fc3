#include "mapping/markings/preprocess.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::markings {

bool is_zigzag(const Polyline& points, const PreprocessConfig& config) {
  const double min_cosine = cos_degrees(config.zigzag_angle_deg);
  std::optional<Eigen::Vector2d> previous;
  std::size_t start = 0;
  int turns = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d segment = (points[i] - points[start]).head<2>();
    const double segment_m = segment.norm();
    if (segment_m < config.zigzag_min_segment_m) continue;
    const Eigen::Vector2d direction = segment / segment_m;
    if (previous && previous->dot(direction) < min_cosine) ++turns;
    previous = direction;
    start = i;
  }
  return turns >= config.zigzag_turns;
}

std::vector<ObservedMarking> preprocess(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                        const PreprocessConfig& config) {
  std::vector<ObservedMarking> markings;
  markings.reserve(frame.detections.size());
  for (const Detection& detection : frame.detections) {
    if (detection.points.size() < 2) continue;
    if (config.reject_zigzag && is_zigzag(detection.points, config)) continue;
    ObservedMarking marking{.type = detection.type,
                            .style = detection.style,
                            .confidence = detection.confidence,
                            .points = {},
                            .stddev_m = detection.stddev_m,
                            .belief = detection.confidence};
    marking.points.reserve(detection.points.size());
    for (const Point& point_body : detection.points) marking.points.push_back(T_map_body * point_body);
    markings.push_back(std::move(marking));
  }
  return markings;
}

void drop_unsure(const PreprocessConfig& config, std::vector<ObservedMarking>& markings) {
  std::erase_if(markings, [&](const ObservedMarking& marking) {
    return std::max(marking.confidence, marking.belief) < config.min_confidence;
  });
}

}  // namespace laneloom::markings
