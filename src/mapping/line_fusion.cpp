#include "mapping/line_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kBirthTrust = 0.25;  // what was seen once is not yet known to be the line

double distance(const Point& point, const Point& origin) { return (point - origin).head<2>().norm(); }

/// Inverse variance of one observation from `range_m` away.
double information(double range_m, const FusionConfig& config) {
  const double stddev_m = config.stddev_m + config.stddev_per_m * range_m;
  return 1.0 / (stddev_m * stddev_m);
}

/// What a match says at a whole station: its samples interpolated.
struct Observation {
  double lateral_m, height_m;
  double end_distance_m;  ///< along the detection, to its nearer end
};

void observe(Station& station, const Observation& seen, const Eigen::Vector2d& direction, const Point& origin,
             const FusionConfig& config) {
  const double range_m = distance(station.position, origin);
  const double weight_per_m2 = information(range_m, config);
  // Near its ends a detection swings.
  const double end_trust = std::min(1.0, (seen.end_distance_m + 0.5) / config.end_reach_m);
  const double weight = weight_per_m2 * end_trust * end_trust;
  const double gain = weight / (station.information_per_m2 + weight);
  station.position.head<2>() += gain * seen.lateral_m * Eigen::Vector2d(-direction.y(), direction.x());
  station.position.z() += gain * seen.height_m;
  station.information_per_m2 = std::min(station.information_per_m2 + weight, config.max_information_per_m2);
  station.closest_m = std::min(station.closest_m, range_m);
}

Station new_station(const Point& position, const Point& origin, const SampledDetection& detection,
                    double log_odds, const FusionConfig& config) {
  const double range_m = distance(position, origin);
  Station station{.position = position,
                  .information_per_m2 = kBirthTrust * information(range_m, config),
                  .closest_m = range_m,
                  .log_odds = log_odds};
  station.style_votes[index(detection.style)] += 1.0;
  return station;
}

double hit(const SampledDetection& detection, const FusionConfig& config) {
  return config.hit_log_odds * 4.0 * detection.confidence * detection.confidence;
}

void fuse(const LineMatch& match, const SampledDetection& detection, const Point& origin,
          const FusionConfig& config, Line& line, std::vector<bool>& observed) {
  const auto end_distance_m = [&](std::size_t sample) {
    return static_cast<double>(std::min(sample, detection.samples.size() - 1 - sample)) * detection.spacing_m;
  };
  for (std::size_t i = 1; i < match.samples.size(); ++i) {
    const SampleMatch& a = match.samples[i - 1];
    const SampleMatch& b = match.samples[i];
    if (b.sample > a.sample + 2) continue;
    const double low = std::min(a.foot.index, b.foot.index), high = std::max(a.foot.index, b.foot.index);
    for (auto k = static_cast<std::size_t>(std::max(0.0, std::ceil(low - 0.5)));
         k < line.stations.size() && static_cast<double>(k) <= high + 0.5; ++k) {
      if (observed[k]) continue;
      observed[k] = true;
      const double share =
          high > low
              ? std::clamp((static_cast<double>(k) - a.foot.index) / (b.foot.index - a.foot.index), 0.0, 1.0)
              : 0.0;
      const auto mix = [share](double from, double to) { return from + share * (to - from); };
      const Observation seen{mix(a.foot.lateral_m, b.foot.lateral_m), mix(a.foot.height_m, b.foot.height_m),
                             end_distance_m(a.sample)};
      Station& station = line.stations[k];
      observe(station, seen, direction_at(line, k), origin, config);
      station.log_odds = std::min(station.log_odds + hit(detection, config), config.max_log_odds);
      station.style_votes[index(detection.style)] += 1.0;
    }
  }
  line.type_votes[index(detection.type)] += static_cast<double>(match.samples.size());
  ++line.observations;
}

/// Between stations; the last one may be nearer, so that a line reaches as far as it was seen.
double min_spacing(bool is_last, const FusionConfig& config) {
  return is_last ? 0.5 * config.station_spacing_m : config.station_spacing_m - 0.5 * config.sample_step_m;
}

/// Appends stations at the back of `line` along `ahead`, the samples that follow. The step between the fused
/// end and this one detection fades out.
void extend_back(std::span<const Point> ahead, const Point& step, const Point& origin,
                 const SampledDetection& detection, const FusionConfig& config, Line& line) {
  for (const Point& sample : ahead) {
    const Point& end = line.stations.back().position;
    const double run_m = (sample - ahead.front()).head<2>().norm();
    const Point corrected = sample - step * std::max(0.0, 1.0 - run_m / config.fade_m);
    const Eigen::Vector2d gap = (corrected - end).head<2>();
    const Eigen::Vector2d direction = direction_at(line, line.stations.size() - 1);
    if (gap.norm() < min_spacing(&sample == &ahead.back(), config) || gap.dot(direction) <= 0.0) continue;
    line.stations.push_back(new_station(corrected, origin, detection, config.extension_log_odds, config));
  }
}

/// The unexplained samples that follow `from` in one direction, marked as explained.
Polyline take_following(SampledDetection& detection, std::size_t from, bool upwards) {
  Polyline ahead;
  const auto count = static_cast<std::ptrdiff_t>(detection.samples.size());
  for (auto i = static_cast<std::ptrdiff_t>(from) + (upwards ? 1 : -1); i >= 0 && i < count;
       i += upwards ? 1 : -1) {
    const auto k = static_cast<std::size_t>(i);
    if (detection.explained[k]) break;
    detection.explained[k] = true;
    ahead.push_back(detection.samples[k]);
  }
  return ahead;
}

}  // namespace

StationsObserved fuse_matches(const std::vector<LineMatch>& matches,
                              const std::vector<SampledDetection>& detections, const Point& origin,
                              const FusionConfig& config, std::vector<Line>& lines) {
  StationsObserved observed(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) observed[i].assign(lines[i].stations.size(), false);
  for (const LineMatch& match : matches) {
    fuse(match, detections[match.detection], origin, config, lines[match.line], observed[match.line]);
  }
  return observed;
}

void extend_lines(const std::vector<LineMatch>& matches, const Point& origin, const FusionConfig& config,
                  std::vector<SampledDetection>& detections, std::vector<Line>& lines) {
  for (const LineMatch& match : matches) {
    SampledDetection& detection = detections[match.detection];
    Line& line = lines[match.line];
    for (const bool at_back : {true, false}) {
      const auto by_index = [](const SampleMatch& s) { return s.foot.index; };
      const SampleMatch& outermost = at_back ? *std::ranges::max_element(match.samples, {}, by_index)
                                             : *std::ranges::min_element(match.samples, {}, by_index);
      const double end = at_back ? static_cast<double>(line.stations.size() - 1) : 0.0;
      if (std::abs(outermost.foot.index - end) > 1.5) continue;
      const SampleMatch& other =
          outermost.sample == match.samples.front().sample ? match.samples.back() : match.samples.front();
      const Polyline ahead = take_following(detection, outermost.sample, outermost.sample > other.sample);
      if (ahead.empty()) continue;
      const auto end_station = static_cast<std::size_t>(end);
      const Eigen::Vector2d direction = direction_at(line, end_station);
      const double lateral_m = foot_at(line, end_station, detection.samples[outermost.sample]).lateral_m;
      Point step = Point::Zero();
      step.head<2>() = lateral_m * Eigen::Vector2d(-direction.y(), direction.x());
      if (!at_back) std::ranges::reverse(line.stations);
      extend_back(ahead, step, origin, detection, config, line);
      if (!at_back) std::ranges::reverse(line.stations);
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
          line.stations.push_back(new_station(sample, origin, detection, config.birth_log_odds, config));
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

namespace {

/// By crossings of a ray (even-odd).
bool contains(const Polyline& polygon, const Point& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point &a = polygon[i], &b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

}  // namespace

bool View::sees(const Point& point_map, MarkingType type, const LocalRange& range) const {
  const auto& types = frame->detected_types;
  if (!types.empty() && std::ranges::find(types, type) == types.end()) return false;
  const Point point = T_body_map * point_map;
  const bool in_view =
      frame->field_of_view.empty() ? range.shows(point_map) : contains(frame->field_of_view, point);
  return in_view && std::ranges::none_of(frame->occluded_areas,
                                         [&](const Polyline& area) { return contains(area, point); });
}

void discount_unobserved(const StationsObserved& observed, const View& view, const LocalRange& range,
                         const FusionConfig& config, std::vector<Line>& lines) {
  for (std::size_t i = 0; i < observed.size(); ++i) {
    Line& line = lines[i];
    for (std::size_t k = 0; k < observed[i].size(); ++k) {
      Station& station = line.stations[k];
      if (observed[i][k] || !view.sees(station.position, line.type(), range)) continue;
      const double range_m = (view.T_body_map * station.position).head<2>().norm();
      station.log_odds -= config.miss_log_odds * std::max(0.0, 1.0 - range_m / config.miss_range_m);
    }
  }
}

void prune_lines(const LocalRange& range, const FusionConfig& config, std::vector<Line>& lines,
                 ElementId& next_id) {
  std::vector<Line> kept;
  std::vector<Line> split_off;
  for (Line& line : lines) {
    const auto dead = [&](const Station& s) {
      return s.log_odds < config.min_log_odds || !range.keeps(s.position);
    };
    if (line.stations.size() >= 2 && std::ranges::none_of(line.stations, dead)) {
      kept.push_back(std::move(line));
      continue;
    }
    std::vector<Line> pieces;
    for (std::size_t begin = 0; begin < line.stations.size();) {
      std::size_t end = begin;
      while (end < line.stations.size() && !dead(line.stations[end])) ++end;
      if (end >= begin + 2) {
        Line piece = line;
        piece.stations.assign(line.stations.begin() + static_cast<std::ptrdiff_t>(begin),
                              line.stations.begin() + static_cast<std::ptrdiff_t>(end));
        pieces.push_back(std::move(piece));
      }
      begin = std::max(end, begin + 1);
    }
    if (pieces.empty()) continue;
    // The longest piece keeps the id.
    const auto longest =
        std::ranges::max_element(pieces, {}, [](const Line& piece) { return piece.stations.size(); });
    kept.push_back(*longest);
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
      if (piece == longest) continue;
      piece->id = next_id++;
      split_off.push_back(std::move(*piece));
    }
  }
  lines = std::move(kept);
  std::ranges::move(split_off, std::back_inserter(lines));
}

}  // namespace laneloom
