#include "mapping/association.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "laneloom/polyline.hpp"
#include "mapping/nearest_stations.hpp"

namespace laneloom {
namespace {

struct Candidate {
  double score = 0.0;
  LineMatch match;
};

Eigen::Vector2d direction_of(const Polyline& samples, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, samples.size() - 1);
  return (samples[after] - samples[before]).head<2>().normalized();
}

/// All lines that a detection's samples lie beside, with the samples that do.
void find_candidates(std::size_t index, const SampledDetection& detection, const std::vector<Line>& lines,
                     double min_cosine, double gate_m, NearestStations& nearest_stations,
                     std::vector<Candidate>& candidates) {
  std::map<std::uint32_t, Candidate> by_line;
  for (std::size_t i = 0; i < detection.samples.size(); ++i) {
    const Point& point = detection.samples[i];
    for (const NearestStation& n : nearest_stations.around(point)) {
      const Line& line = lines[n.line];
      const StationFoot foot = foot_at(line, n.station, point);
      const auto last = static_cast<double>(line.stations.size() - 1);
      if (foot.index < -0.5 || foot.index > last + 0.5 || std::abs(foot.lateral_m) > gate_m) continue;
      if (std::abs(direction_of(detection.samples, i).dot(direction_at(line, n.station))) < min_cosine)
        continue;
      Candidate& candidate = by_line[n.line];
      const double fit = foot.lateral_m / gate_m;
      candidate.score += 1.0 - fit * fit;
      candidate.match.samples.push_back({i, foot});
    }
  }
  for (auto& [line, candidate] : by_line) {
    candidate.match.detection = index;
    candidate.match.line = line;
    candidates.push_back(std::move(candidate));
  }
}

}  // namespace

std::vector<SampledDetection> sample_detections(const std::vector<ObservedMarking>& markings,
                                                const FusionConfig& config) {
  std::vector<SampledDetection> detections;
  detections.reserve(markings.size());
  for (const ObservedMarking& marking : markings) {
    const MeasuredPolyline line(marking.points);
    if (line.length() <= 0.0) continue;
    SampledDetection detection{
        line.resample(config.sample_step_m), marking.type, marking.style, marking.confidence, {}};
    detection.explained.assign(detection.samples.size(), false);
    detections.push_back(std::move(detection));
  }
  return detections;
}

std::vector<LineMatch> associate(const std::vector<Line>& lines, const FusionConfig& config,
                                 std::vector<SampledDetection>& detections) {
  const double min_cosine = cos_degrees(config.gate_angle_deg);
  NearestStations along(lines, false, config.gate_m), across(lines, true, config.gate_m);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    find_candidates(i, detections[i], lines, min_cosine, config.gate_m,
                    is_stopline(detections[i].type) ? across : along, candidates);
  }
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::score);

  std::vector<std::vector<bool>> observed(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) observed[i].assign(lines[i].stations.size(), false);
  std::vector<LineMatch> matches;
  for (auto& [score, match] : candidates) {
    auto& explained = detections[match.detection].explained;
    auto& taken = observed[match.line];
    const auto station = [](const SampleMatch& s) {
      return static_cast<std::size_t>(std::lround(std::max(0.0, s.foot.index - 1e-6)));
    };
    std::erase_if(match.samples,
                  [&](const SampleMatch& s) { return explained[s.sample] || taken[station(s)]; });
    if (static_cast<double>(match.samples.size()) * config.sample_step_m < config.min_overlap_m) continue;
    for (const SampleMatch& s : match.samples) explained[s.sample] = true;
    const auto [first, last] =
        std::ranges::minmax(match.samples, {}, [](const SampleMatch& s) { return s.foot.index; });
    for (std::size_t k = station(first); k <= station(last); ++k) taken[k] = true;
    matches.push_back(std::move(match));
  }
  return matches;
}

}  // namespace laneloom
