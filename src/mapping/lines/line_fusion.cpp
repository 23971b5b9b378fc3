#include "mapping/lines/line_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kBirthTrust = 0.25;   // what was seen once is not yet known to be the line
constexpr double kTypeMemory = 0.98;   // per observation: the border of a road may become another
constexpr double kMinStddev_m = 0.02;  // of an observation, whatever is said of it

double distance(const Point& point, const Point& origin) { return (point - origin).head<2>().norm(); }

/// Standard deviation of one observation from `range_m` away, unless its sample has one of its own.
double stddev_m(const SampledDetection& detection, std::size_t sample, double range_m,
                const FusionConfig& config) {
  if (!detection.stddev_m.empty()) return std::max(kMinStddev_m, detection.stddev_m[sample]);
  return config.stddev_m + config.stddev_per_m * range_m;
}

/// What a match says at a whole station: its samples interpolated.
struct Observation {
  std::size_t station;
  Eigen::Vector2d direction;  ///< of the line there
  double lateral_m, height_m, stddev_m;
  double end_distance_m;  ///< along the detection, to its nearer end
};

void observe(Station& station, const Observation& seen, const Point& origin, const FusionConfig& config) {
  const double weight_per_m2 = 1.0 / (seen.stddev_m * seen.stddev_m);
  // Near its ends a detection swings.
  const double end_trust = std::min(1.0, (seen.end_distance_m + 0.5) / config.end_reach_m);
  const double weight = weight_per_m2 * end_trust * end_trust;
  const double gain = weight / (station.information_per_m2 + weight);
  station.position.head<2>() +=
      gain * seen.lateral_m * Eigen::Vector2d(-seen.direction.y(), seen.direction.x());
  station.position.z() += gain * seen.height_m;
  station.information_per_m2 = std::min(station.information_per_m2 + weight, config.max_information_per_m2);
  station.closest_m = std::min(station.closest_m, distance(station.position, origin));
}

Station new_station(const Point& position, const Point& origin, const SampledDetection& detection,
                    std::size_t sample, double log_odds, const FusionConfig& config) {
  const double range_m = distance(position, origin);
  const double deviation_m = stddev_m(detection, sample, range_m, config);
  Station station{.position = position,
                  .information_per_m2 = kBirthTrust / (deviation_m * deviation_m),
                  .closest_m = range_m,
                  .log_odds = log_odds};
  station.style_votes[index(detection.style)] += 1.0;
  return station;
}

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
  Observations(const SampledDetection& detection, Line& line, const Point& origin, const FusionConfig& config)
      : detection_(detection), line_(line), origin_(origin), config_(config) {}

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
  double end_distance_m(std::size_t sample) const {
    const std::size_t last = detection_.samples.size() - 1;
    return static_cast<double>(std::min(sample, last - sample)) * detection_.spacing_m;
  }

  /// What two samples that follow one another say at a station.
  Observation between(const SampleMatch& a, const SampleMatch& b, std::size_t station) const {
    const double run = b.foot.index - a.foot.index;
    const double share =
        run != 0.0 ? std::clamp((static_cast<double>(station) - a.foot.index) / run, 0.0, 1.0) : 0.0;
    const auto mix = [share](double from, double to) { return from + share * (to - from); };
    const double range_m = distance(line_.stations[station].position, origin_);
    return {.station = station,
            .direction = direction_at(line_, station),
            .lateral_m = mix(a.foot.lateral_m, b.foot.lateral_m),
            .height_m = mix(a.foot.height_m, b.foot.height_m),
            .stddev_m = mix(stddev_m(detection_, a.sample, range_m, config_),
                            stddev_m(detection_, b.sample, range_m, config_)),
            .end_distance_m = mix(end_distance_m(a.sample), end_distance_m(b.sample))};
  }

  const SampledDetection& detection_;
  Line& line_;
  const Point& origin_;
  const FusionConfig& config_;
  std::vector<Observation> all_;
};

void fuse(const LineMatch& match, const SampledDetection& detection, const Point& origin,
          const FusionConfig& config, Line& line) {
  Observations seen(detection, line, origin, config);
  seen.gather(match.samples);
  for (const Observation& observation : seen.all()) {
    Station& station = line.stations[observation.station];
    observe(station, observation, origin, config);
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
    line.stations.push_back(new_station(corrected, origin, detection, i, config.extension_log_odds, config));
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
                  const Point& origin, const FusionConfig& config, std::vector<Line>& lines) {
  for (Line& line : lines)
    for (Station& station : line.stations) station.sight = Sight::out_of_view;
  for (const LineMatch& match : matches)
    fuse(match, detections[match.detection], origin, config, lines[match.line]);
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
        if (!near)
          line.stations.push_back(new_station(sample, origin, detection, i, config.birth_log_odds, config));
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
