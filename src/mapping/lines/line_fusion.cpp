#include "mapping/lines/line_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kTypeMemory = 0.98;  // per observation: the border of a road may become another

double hit(const SampledDetection& detection, const FusionConfig& config) {
  return config.hit_log_odds * 4.0 * detection.confidence * detection.confidence;
}

/// Whether a detection was seen on a line from the one sample to the next that matched.
bool is_seen_through(const SampleMatch& from, const SampleMatch& to) {
  return to.sample <= from.sample + 2 && is_led_through(from, to);
}

/// What a detection says of a line. All of it is gathered before any is applied: a station that has moved
/// would turn its neighbours' normals.
class Observations {
 public:
  Observations(const SampledDetection& detection, Line& line) : detection_(detection), line_(line) {}

  /// Leaves out what is observed already, and marks the rest.
  void gather(const std::vector<SampleMatch>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const SampleMatch &a = samples[i - 1], &b = samples[i];
      if (!is_seen_through(a, b)) continue;
      // Where it begins and ends, the nearest station is seen, too.
      const double before = i > 1 && is_seen_through(samples[i - 2], a) ? 0.0 : 0.5;
      const double after = i + 1 < samples.size() && is_seen_through(b, samples[i + 1]) ? 0.0 : 0.5;
      const bool forwards = a.foot.index <= b.foot.index;
      const double low = forwards ? a.foot.index - before : b.foot.index - after;
      const double high = forwards ? b.foot.index + after : a.foot.index + before;
      for (auto k = static_cast<std::size_t>(std::max(0.0, std::ceil(low)));
           k < line_.stations.size() && static_cast<double>(k) <= high; ++k) {
        if (std::exchange(line_.stations[k].sight, Sight::observed) == Sight::observed) continue;
        all_.push_back(between(a, b, k));
      }
    }
  }
  const std::vector<Observation>& all() const { return all_; }

 private:
  /// What two samples that follow one another say at a station.
  Observation between(const SampleMatch& a, const SampleMatch& b, std::size_t station) const {
    const double run = b.foot.index - a.foot.index;
    const double share =
        run != 0.0 ? std::clamp((static_cast<double>(station) - a.foot.index) / run, 0.0, 1.0) : 0.0;
    const auto mix = [share](double from, double to) { return from + share * (to - from); };
    return {.station = station,
            .direction = direction_at(line_, station),
            .lateral_m = mix(a.foot.lateral_m, b.foot.lateral_m),
            .height_m = mix(a.foot.height_m, b.foot.height_m),
            .stddev_m = mix(detection_.stddev_m[a.sample], detection_.stddev_m[b.sample])};
  }

  const SampledDetection& detection_;
  Line& line_;
  std::vector<Observation> all_;
};

void fuse(const LineMatch& match, const SampledDetection& detection, const Viewpoint& from,
          const FusionConfig& config, NetworkModels& networks, Line& line) {
  Observations seen(detection, line);
  seen.gather(match.samples);
  for (const Observation& observation : seen.all()) {
    Station& station = line.stations[observation.station];
    if (config.learn) learn(observation, from, station, networks);
    observe(observation, from, station);
    station.log_odds = std::min(station.log_odds + hit(detection, config), config.max_log_odds);
    station.style_votes[index(detection.style)] += 1.0;
  }
  for (double& votes : line.type_votes) votes *= kTypeMemory;
  line.type_votes[index(detection.type)] += static_cast<double>(match.samples.size());
  ++line.observations;
}

/// Between stations; the last one may be nearer, so that a line reaches as far as it was seen.
double min_spacing(bool is_last, const FusionConfig& config) {
  return is_last ? 0.5 * config.station_spacing_m : config.station_spacing_m - 0.5 * config.sample_step_m;
}

/// Appends stations at the back of `line` along `ahead`, the samples that follow. The step between the fused
/// end and this one detection fades out.
void extend_back(const std::vector<std::size_t>& ahead, const Point& step, const Point& origin,
                 const SampledDetection& detection, const FusionConfig& config, Line& line) {
  const Point& first = detection.samples[ahead.front()];
  for (const std::size_t i : ahead) {
    const Point& sample = detection.samples[i];
    const Point& end = line.stations.back().position;
    const double run_m = (sample - first).head<2>().norm();
    const Point corrected = sample - step * std::max(0.0, 1.0 - run_m / config.fade_m);
    const Eigen::Vector2d gap = (corrected - end).head<2>();
    const Eigen::Vector2d direction = direction_at(line, line.stations.size() - 1);
    if (gap.norm() < min_spacing(i == ahead.back(), config) || gap.dot(direction) <= 0.0) continue;
    line.stations.push_back(new_station(corrected, origin, detection, i, config.extension_log_odds));
  }
}

/// The unexplained samples in the range that follow `from` in one direction, marked as explained.
std::vector<std::size_t> take_following(const LocalRange& range, std::size_t from, bool upwards,
                                        SampledDetection& detection) {
  std::vector<std::size_t> ahead;
  const auto count = static_cast<std::ptrdiff_t>(detection.samples.size());
  for (auto i = static_cast<std::ptrdiff_t>(from) + (upwards ? 1 : -1); i >= 0 && i < count;
       i += upwards ? 1 : -1) {
    const auto k = static_cast<std::size_t>(i);
    if (detection.explained[k] || !range.keeps(detection.samples[k])) break;
    detection.explained[k] = true;
    ahead.push_back(k);
  }
  return ahead;
}

/// Extends one end of a line by what a detection saw beyond it.
void extend_line(const LineMatch& match, bool at_back, const Point& origin, const LocalRange& range,
                 const FusionConfig& config, SampledDetection& detection, Line& line) {
  const auto by_index = [](const SampleMatch& s) { return s.foot.index; };
  const SampleMatch& outermost = at_back ? *std::ranges::max_element(match.samples, {}, by_index)
                                         : *std::ranges::min_element(match.samples, {}, by_index);
  const std::size_t end = at_back ? line.stations.size() - 1 : 0;
  if (std::abs(outermost.foot.index - static_cast<double>(end)) > 1.5) return;
  const SampleMatch& other =
      outermost.sample == match.samples.front().sample ? match.samples.back() : match.samples.front();
  const auto ahead = take_following(range, outermost.sample, outermost.sample > other.sample, detection);
  if (ahead.empty()) return;
  const Eigen::Vector2d direction = direction_at(line, end);
  const double lateral_m = foot_at(line, end, detection.samples[outermost.sample]).lateral_m;
  Point step = Point::Zero();
  step.head<2>() = lateral_m * Eigen::Vector2d(-direction.y(), direction.x());
  if (!at_back) std::ranges::reverse(line.stations);
  extend_back(ahead, step, origin, detection, config, line);
  if (!at_back) std::ranges::reverse(line.stations);
}

}  // namespace

void fuse_matches(const std::vector<LineMatch>& matches, const std::vector<SampledDetection>& detections,
                  const Viewpoint& from, const FusionConfig& config, NetworkModels& networks,
                  std::vector<Line>& lines) {
  for (Line& line : lines)
    for (Station& station : line.stations) station.sight = Sight::out_of_view;
  for (const LineMatch& match : matches)
    fuse(match, detections[match.detection], from, config, networks, lines[match.line]);
}

void extend_lines(const std::vector<LineMatch>& matches, const Point& origin, const LocalRange& range,
                  const FusionConfig& config, std::vector<SampledDetection>& detections,
                  std::vector<Line>& lines) {
  // The matches know the stations by number: the front ends come last, and each end is extended once.
  for (const bool at_back : {true, false}) {
    std::vector<std::size_t> before;
    before.reserve(lines.size());
    for (const Line& line : lines) before.push_back(line.stations.size());
    for (const LineMatch& match : matches) {
      Line& line = lines[match.line];
      if (line.stations.size() == before[match.line])
        extend_line(match, at_back, origin, range, config, detections[match.detection], line);
    }
  }
}

void create_lines(const std::vector<SampledDetection>& detections, const Point& origin, std::int64_t stamp_ns,
                  const LocalRange& range, const FusionConfig& config, std::vector<Line>& lines,
                  ElementId& next_id) {
  for (const SampledDetection& detection : detections) {
    const std::size_t count = detection.samples.size();
    for (std::size_t begin = 0; begin < count;) {
      std::size_t end = begin;
      while (end < count && !detection.explained[end] && range.keeps(detection.samples[end])) ++end;
      Line line{.stations = {}, .observations = 1, .first_seen_ns = stamp_ns};
      double length_m = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        length_m += detection.share_m(i);
        const Point& sample = detection.samples[i];
        const bool near =
            !line.stations.empty() &&
            (sample - line.stations.back().position).head<2>().norm() < min_spacing(i + 1 == end, config);
        if (!near) line.stations.push_back(new_station(sample, origin, detection, i, config.birth_log_odds));
      }
      if (line.stations.size() >= 2 && length_m >= config.min_birth_length_m) {
        line.id = next_id++;
        line.type_votes[index(detection.type)] = static_cast<double>(end - begin);
        lines.push_back(std::move(line));
      }
      begin = std::max(end, begin + 1);
    }
  }
}

}  // namespace laneloom
