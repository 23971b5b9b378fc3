#include "mapping/markings/preprocess.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::markings {

namespace {

constexpr double kSquare_deg = 100.0;  // a larger turn leads backwards

}  // namespace

bool is_zigzag(const Polyline& points, MarkingType type, const PreprocessConfig& config) {
  const bool is_edge = type == MarkingType::roadedge;
  const double min_cosine = cos_degrees(config.zigzag_angle_deg), backwards = cos_degrees(kSquare_deg);
  const int most = config.zigzag_turns + (is_edge ? 1 : 0);
  std::optional<Eigen::Vector2d> previous;
  std::size_t start = 0;
  double last_turn = 0.0;  // its sign tells the side
  int turns = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d segment = (points[i] - points[start]).head<2>();
    const double segment_m = segment.norm();
    if (segment_m < config.zigzag_min_segment_m) continue;
    const Eigen::Vector2d direction = segment / segment_m;
    if (previous && previous->dot(direction) < min_cosine) {
      const double turn = cross(*previous, direction);
      if (is_edge && turn * last_turn > 0.0) turns = 0;
      turns += is_edge && previous->dot(direction) < backwards ? 2 : 1;
      last_turn = turn;
    }
    if (turns >= most) return true;
    previous = direction;
    start = i;
  }
  return false;
}

std::vector<ObservedMarking> preprocess(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                                        const PreprocessConfig& config) {
  std::vector<ObservedMarking> markings;
  markings.reserve(frame.detections.size());
  for (std::size_t number = 0; number < frame.detections.size(); ++number) {
    const Detection& detection = frame.detections[number];
    if (detection.points.size() < 2) continue;
    if (config.reject_zigzag && is_zigzag(detection.points, detection.type, config)) continue;
    ObservedMarking marking{.type = detection.type,
                            .style = detection.style,
                            .confidence = detection.confidence,
                            .points = {},
                            .stddev_m = detection.stddev_m,
                            .belief = detection.confidence,
                            .number = number};
    marking.points.reserve(detection.points.size());
    for (const Point& point_body : detection.points) marking.points.push_back(T_map_body * point_body);
    markings.push_back(std::move(marking));
  }
  return markings;
}

std::size_t drop_unsure(const PreprocessConfig& config, std::vector<ObservedMarking>& markings) {
  return std::erase_if(markings, [&](const ObservedMarking& marking) {
    return std::max(marking.confidence, marking.belief) < config.min_confidence;
  });
}

}  // namespace laneloom::markings
