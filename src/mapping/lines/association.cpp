#include "mapping/lines/association.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom {
namespace {

constexpr double kMaxStations = 3.0;  // between the feet of two samples that follow one another

/// Per sample what was given per vertex.
std::vector<double> deviations(const ObservedMarking& marking, const SampledDetection& detection) {
  const std::vector<double> arc_m = arc_lengths(marking.points);
  std::vector<double> result;
  result.reserve(detection.samples.size());
  for (std::size_t i = 0; i < detection.samples.size(); ++i)
    result.push_back(deviation_at(arc_m, marking.stddev_m, static_cast<double>(i) * detection.spacing_m));
  return result;
}

Eigen::Vector2d direction_of(const Polyline& samples, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, samples.size() - 1);
  return (samples[after] - samples[before]).head<2>().normalized();
}

/// The station that a sample observes; of two equally near ones the former.
std::size_t observed_station(const SampleMatch& s) {
  constexpr double kTie = 1e-6;
  return static_cast<std::size_t>(std::lround(std::max(0.0, s.foot.index - kTie)));
}

/// Which samples of the detections are matched, and which stations of the lines are observed.
class Claims {
 public:
  Claims(const std::vector<SampledDetection>& detections, const std::vector<Line>& lines)
      : matched_(detections.size()), observed_(lines.size()) {
    for (std::size_t i = 0; i < detections.size(); ++i) matched_[i].resize(detections[i].samples.size());
    for (std::size_t i = 0; i < lines.size(); ++i) observed_[i].resize(lines[i].stations.size());
  }

  void remove_claimed(LineMatch& match) const {
    std::erase_if(match.samples, [&](const SampleMatch& s) {
      return matched_[match.detection][s.sample] || observed_[match.line][observed_station(s)];
    });
  }

  /// Also the stations between two samples that follow one another.
  void claim(const LineMatch& match) {
    for (std::size_t i = 0; i < match.samples.size(); ++i) {
      const SampleMatch& s = match.samples[i];
      matched_[match.detection][s.sample] = true;
      const bool led = i > 0 && is_led_through(match.samples[i - 1], s);
      const auto [low, high] =
          std::minmax({observed_station(s), observed_station(led ? match.samples[i - 1] : s)});
      for (std::size_t k = low; k <= high; ++k) observed_[match.line][k] = true;
    }
  }

 private:
  std::vector<std::vector<bool>> matched_, observed_;
};

}  // namespace

bool is_led_through(const SampleMatch& from, const SampleMatch& to) {
  return std::abs(to.foot.index - from.foot.index) <=
         kMaxStations * static_cast<double>(to.sample - from.sample);
}

std::vector<SampledDetection> sample_detections(const std::vector<ObservedMarking>& markings,
                                                const FusionConfig& config) {
  std::vector<SampledDetection> detections;
  detections.reserve(markings.size());
  for (const ObservedMarking& marking : markings) {
    const MeasuredPolyline line(marking.points);
    if (line.length() <= 0.0) continue;
    SampledDetection detection{.samples = line.resample(config.sample_step_m),
                               .type = marking.type,
                               .style = marking.style,
                               .confidence = marking.confidence};
    detection.spacing_m = line.length() / static_cast<double>(detection.samples.size() - 1);
    if (!marking.stddev_m.empty()) detection.stddev_m = deviations(marking, detection);
    detection.explained.assign(detection.samples.size(), false);
    detections.push_back(std::move(detection));
  }
  return detections;
}

struct LineMatcher::Candidate {
  double score = 0.0;
  LineMatch match;
};

LineMatcher::LineMatcher(const std::vector<Line>& lines, const FusionConfig& config)
    : lines_(lines),
      config_(config),
      min_cosine_(cos_degrees(config.gate_angle_deg)),
      along_(lines, false, config.gate_m),
      across_(lines, true, config.gate_m) {}

/// All lines that a detection's samples lie beside, with the samples that do.
void LineMatcher::find_candidates(std::size_t index, const SampledDetection& detection, std::size_t stride,
                                  std::vector<Candidate>& candidates) {
  NearestStations& nearest_stations = is_stopline(detection.type) ? across_ : along_;
  const auto first = std::ssize(candidates);
  const auto of_line = [&](std::size_t line) -> Candidate& {
    const auto known = std::find_if(candidates.begin() + first, candidates.end(),
                                    [line](const Candidate& c) { return c.match.line == line; });
    if (known != candidates.end()) return *known;
    candidates.push_back({0.0, {index, line, {}}});
    candidates.back().match.samples.reserve(detection.samples.size() / stride + 1);
    return candidates.back();
  };
  for (std::size_t i = 0; i < detection.samples.size(); i += stride) {
    const Point& point = detection.samples[i];
    const Eigen::Vector2d direction = direction_of(detection.samples, i);
    for (const NearestStation& n : nearest_stations.around(point)) {
      const Line& line = lines_[n.line];
      const StationFoot foot = foot_at(line, n.station, point);
      const auto last = static_cast<double>(line.stations.size() - 1);
      if (foot.index < -0.5 || foot.index > last + 0.5) continue;
      if (std::abs(foot.lateral_m) > config_.gate_m) continue;
      if (std::abs(direction.dot(direction_at(line, n.station))) < min_cosine_) continue;
      Candidate& candidate = of_line(n.line);
      const double fit = foot.lateral_m / config_.gate_m;
      candidate.score += 1.0 - fit * fit;
      candidate.match.samples.push_back({i, foot});
    }
  }
  std::sort(candidates.begin() + first, candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.match.line < b.match.line; });
}

std::vector<LineMatch> LineMatcher::match(const std::vector<SampledDetection>& detections,
                                          std::size_t stride) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < detections.size(); ++i) find_candidates(i, detections[i], stride, candidates);
  std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::score);

  Claims claims(detections, lines_);
  std::vector<LineMatch> matches;
  matches.reserve(candidates.size());
  for (auto& [score, match] : candidates) {
    claims.remove_claimed(match);
    double overlap_m = 0.0;
    for (const SampleMatch& s : match.samples) overlap_m += detections[match.detection].share_m(s.sample);
    if (match.samples.size() < 2 || overlap_m * static_cast<double>(stride) < config_.min_overlap_m) continue;
    claims.claim(match);
    matches.push_back(std::move(match));
  }
  return matches;
}

Association associate(LineMatcher& matcher, std::vector<SampledDetection> detections) {
  Association association{.detections = std::move(detections), .matches = {}};
  association.matches = matcher.match(association.detections);
  for (const LineMatch& match : association.matches)
    for (const SampleMatch& s : match.samples)
      association.detections[match.detection].explained[s.sample] = true;
  return association;
}

}  // namespace laneloom
