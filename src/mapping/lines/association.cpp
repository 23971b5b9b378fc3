#include "mapping/lines/association.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lines/line_evidence.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lines {
namespace {

constexpr double kMaxStations = 3.0;  // between the feet of two samples that follow one another
constexpr double kGoodFit = 0.5;      // mean over the samples, which 0.7 of the gate would have

/// The deviations per sample, interpolated from those that were given per vertex.
std::vector<double> deviations(const markings::ObservedMarking& marking, const SampledDetection& detection) {
  const std::vector<double> arc_m = arc_lengths(marking.points);
  std::vector<double> result;
  result.reserve(detection.samples.size());
  for (std::size_t i = 0; i < detection.samples.size(); ++i)
    result.push_back(
        markings::deviation_at(arc_m, marking.stddev_m, static_cast<double>(i) * detection.spacing_m));
  return result;
}

Eigen::Vector2d direction_of(const Polyline& samples, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, samples.size() - 1);
  return (samples[after] - samples[before]).head<2>().normalized();
}

/// The station that a sample observes: the nearest one, and of two equally near ones the first.
std::size_t observed_station(const SampleMatch& s) {
  constexpr double kTie = 1e-6;
  return nearest_station(std::max(0.0, s.foot.index - kTie));
}

/// A flag for each place of several rows.
class Flags {
 public:
  template <class Rows, class Size>
  Flags(const Rows& rows, const Size& size_of) {
    begins_.reserve(rows.size());
    std::size_t count = 0;
    for (const auto& row : rows) {
      begins_.push_back(count);
      count += size_of(row);
    }
    all_.resize(count);
  }
  bool at(std::size_t row, std::size_t place) const { return all_[begins_[row] + place]; }
  void set(std::size_t row, std::size_t place) { all_[begins_[row] + place] = true; }

 private:
  std::vector<bool> all_;
  std::vector<std::size_t> begins_;
};

/// Records which samples of the detections are matched, and which stations of the lines are observed.
class Claims {
 public:
  Claims(const std::vector<SampledDetection>& detections, const std::vector<Line>& lines)
      : matched_(detections, [](const SampledDetection& detection) { return detection.samples.size(); }),
        observed_(lines, [](const Line& line) { return line.stations.size(); }) {}

  bool is_claimed(const LineMatch& match, const SampleMatch& s) const {
    return matched_.at(match.detection, s.sample) || observed_.at(match.line, observed_station(s));
  }

  /// Claims the samples and stations of a match, and the stations between two samples that follow one
  /// another.
  void claim(const LineMatch& match) {
    for (std::size_t i = 0; i < match.samples.size(); ++i) {
      const SampleMatch& s = match.samples[i];
      matched_.set(match.detection, s.sample);
      const bool led = i > 0 && is_led_through(match.samples[i - 1], s);
      const auto [low, high] =
          std::minmax({observed_station(s), observed_station(led ? match.samples[i - 1] : s)});
      for (std::size_t k = low; k <= high; ++k) observed_.set(match.line, k);
    }
  }

 private:
  Flags matched_, observed_;
};

}  // namespace

bool is_led_through(const SampleMatch& from, const SampleMatch& to) {
  return std::abs(to.foot.index - from.foot.index) <=
         kMaxStations * static_cast<double>(to.sample - from.sample);
}

std::vector<SampledDetection> sample_detections(const std::vector<markings::ObservedMarking>& markings,
                                                const FusionConfig& config) {
  std::vector<SampledDetection> detections;
  detections.reserve(markings.size());
  for (const markings::ObservedMarking& marking : markings) {
    const MeasuredPolyline line(marking.points);
    if (line.length() <= 0.0) continue;
    SampledDetection detection{.samples = line.resample(config.sample_step_m),
                               .type = marking.type,
                               .style = marking.style,
                               .confidence = marking.confidence,
                               .belief = marking.belief,
                               .number = marking.number};
    detection.spacing_m = line.length() / static_cast<double>(detection.samples.size() - 1);
    if (!marking.stddev_m.empty()) detection.stddev_m = deviations(marking, detection);
    detection.explained.assign(detection.samples.size(), false);
    detections.push_back(std::move(detection));
  }
  return detections;
}

LineMatcher::LineMatcher(const std::vector<Line>& lines, const FusionConfig& config)
    : lines_(lines),
      config_(config),
      min_cosine_(cos_degrees(config.gate_angle_deg)),
      nearest_stations_(lines, config.gate_m),
      found_(lines.size()) {
  courses_.reserve(lines.size());
  confirmed_.reserve(lines.size());
  for (const Line& line : lines) {
    courses_.emplace_back(line);
    confirmed_.push_back(existence(line.stations, line.beliefs) >= config.confirm_log_odds);
  }
}

/// The foot of a sample on a line that it lies beside and that runs alike. Empty: it does not lie so.
std::optional<StationFoot> LineMatcher::foot(const NearestStation& nearest, const Point& sample,
                                             const Eigen::Vector2d& direction) const {
  const Course& course = courses_[nearest.line];
  if (std::abs(direction.dot(course.direction(nearest.station))) < min_cosine_) return std::nullopt;
  const StationFoot foot = course.foot(nearest.station, sample);
  const auto last = static_cast<double>(course.size() - 1);
  const bool is_beside =
      foot.index >= -0.5 && foot.index <= last + 0.5 && std::abs(foot.lateral_m) <= config_.gate_m;
  return is_beside ? std::optional(foot) : std::nullopt;
}

/// Finds all lines that samples of a detection lie beside, with these samples.
void LineMatcher::find_candidates(std::size_t index, const SampledDetection& detection, std::size_t stride,
                                  Candidates& candidates) {
  const bool across = is_stopline(detection.type);
  hits_.clear();
  for (std::size_t i = 0; i < detection.samples.size(); i += stride) {
    const Point& sample = detection.samples[i];
    const Eigen::Vector2d direction = direction_of(detection.samples, i);
    for (const NearestStation& nearest : nearest_stations_.around(sample, across)) {
      const auto foot = this->foot(nearest, sample, direction);
      if (!foot) continue;
      const double fit = foot->lateral_m / config_.gate_m;
      found_[nearest.line].score += 1.0 - fit * fit;
      ++found_[nearest.line].samples;
      hits_.push_back({nearest.line, {i, *foot}});
    }
  }
  group_hits(index, candidates);
}

/// Groups the hits by line. Within a line they keep the order of the samples.
void LineMatcher::group_hits(std::size_t detection, Candidates& candidates) {
  std::size_t from = candidates.samples.size();
  candidates.samples.resize(from + hits_.size());
  for (std::size_t line = 0; line < found_.size(); ++line) {
    Found& found = found_[line];
    if (found.samples == 0) continue;
    const bool fits_well = found.score > kGoodFit * static_cast<double>(found.samples);
    candidates.all.push_back(
        {confirmed_[line] && fits_well, found.score, detection, line, from, found.samples});
    found.next = from;
    from += found.samples;
  }
  for (const auto& [line, sample] : hits_) candidates.samples[found_[line].next++] = sample;
  for (const auto& [line, sample] : hits_) found_[line] = {};
}

std::vector<LineMatch> LineMatcher::match(const std::vector<SampledDetection>& detections,
                                          std::size_t stride) {
  Candidates candidates;
  std::size_t samples = 0;
  for (const SampledDetection& detection : detections) samples += detection.samples.size() / stride + 1;
  candidates.samples.reserve(samples);
  for (std::size_t i = 0; i < detections.size(); ++i) find_candidates(i, detections[i], stride, candidates);
  std::ranges::stable_sort(candidates.all, std::ranges::greater{},
                           [](const Candidate& c) { return std::pair(c.is_first, c.score); });

  Claims claims(detections, lines_);
  std::vector<LineMatch> matches;
  matches.reserve(candidates.all.size());
  LineMatch match;
  match.samples.reserve(samples);
  for (const Candidate& candidate : candidates.all) {
    match.detection = candidate.detection;
    match.line = candidate.line;
    match.samples.clear();
    double overlap_m = 0.0;
    for (const SampleMatch& sample : std::span(candidates.samples).subspan(candidate.from, candidate.count)) {
      if (claims.is_claimed(match, sample)) continue;
      match.samples.push_back(sample);
      overlap_m += detections[match.detection].share_m(sample.sample);
    }
    if (match.samples.size() < 2 || overlap_m * static_cast<double>(stride) < config_.min_overlap_m) continue;
    claims.claim(match);
    matches.push_back(match);
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

}  // namespace laneloom::lines
