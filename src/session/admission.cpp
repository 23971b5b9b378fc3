#include "session/admission.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

namespace laneloom::session {
namespace {

double length_3d(const Polyline& line) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length_m += (line[i] - line[i - 1]).norm();
  return length_m;
}

/// Squared horizontal distance of the vertex that is nearest to the vehicle; body frame.
double squared_distance(const Polyline& line) {
  double nearest = std::numeric_limits<double>::max();
  for (const Point& point : line) nearest = std::min(nearest, point.head<2>().squaredNorm());
  return nearest;
}

struct Candidate {
  std::size_t index = 0;
  double confidence = 0.0, squared_distance = 0.0, length_m = 0.0;
};

std::vector<Candidate> by_trust(const DetectionFrame& frame) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    const Detection& detection = frame.detections[i];
    candidates.push_back(
        {i, detection.confidence, squared_distance(detection.points), length_3d(detection.points)});
  }
  std::ranges::sort(candidates, {}, [](const Candidate& candidate) {
    return std::tuple(-candidate.confidence, candidate.squared_distance, candidate.index);
  });
  return candidates;
}

}  // namespace

double length_of_markings(const DetectionFrame& frame) {
  double length_m = 0.0;
  for (const Detection& detection : frame.detections) length_m += length_3d(detection.points);
  return length_m;
}

std::size_t admit(const GateConfig& config, DetectionFrame& frame) {
  const auto most = static_cast<std::size_t>(config.max_frame_detections);
  if (frame.detections.size() <= most && length_of_markings(frame) <= config.max_frame_length_m) return 0;
  std::vector<bool> admitted(frame.detections.size(), false);
  std::size_t count = 0;
  double length_m = 0.0;
  for (const Candidate& candidate : by_trust(frame)) {
    if (count == most) break;
    if (length_m + candidate.length_m > config.max_frame_length_m) continue;
    length_m += candidate.length_m;
    admitted[candidate.index] = true;
    ++count;
  }
  std::size_t index = 0;
  std::erase_if(frame.detections, [&](const Detection&) { return !admitted[index++]; });
  return admitted.size() - count;
}

}  // namespace laneloom::session
