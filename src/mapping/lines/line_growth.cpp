#include "mapping/lines/line_growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/station_update.hpp"

namespace laneloom {
namespace {

/// Between stations; the last one may be nearer, so that a line reaches as far as it was seen.
double min_spacing(bool is_last, const FusionConfig& config) {
  return is_last ? 0.5 * config.station_spacing_m : config.station_spacing_m - 0.5 * config.sample_step_m;
}

/// Whether a detection has not yet left the end of `line` with its sample `i`: it lies behind the end, and
/// the detection runs on towards it. Beyond a sharp tip it lies behind, too, but runs away.
bool is_before_end(const std::vector<std::size_t>& ahead, std::size_t i, const SampledDetection& detection,
                   const Line& line) {
  const Point& sample = detection.samples[ahead[i]];
  const Eigen::Vector2d direction = direction_at(line, line.stations.size() - 1);
  if ((sample - line.stations.back().position).head<2>().dot(direction) > 0.0) return false;
  if (i + 1 == ahead.size()) return true;
  return (detection.samples[ahead[i + 1]] - sample).head<2>().dot(direction) > 0.0;
}

/// Appends stations at the back of `line` along `ahead`, the samples that follow. The step between the fused
/// end and this one detection fades out.
void extend_back(const std::vector<std::size_t>& ahead, const Point& step, const Point& origin,
                 const SampledDetection& detection, const FusionConfig& config, Line& line) {
  const Point& first = detection.samples[ahead.front()];
  bool left_end = false;
  for (std::size_t i = 0; i < ahead.size(); ++i) {
    const Point& sample = detection.samples[ahead[i]];
    const double run_m = (sample - first).head<2>().norm();
    const Point corrected = sample - step * std::max(0.0, 1.0 - run_m / config.fade_m);
    const double gap_m = (corrected - line.stations.back().position).head<2>().norm();
    if (gap_m < min_spacing(i + 1 == ahead.size(), config)) continue;
    if (!left_end && is_before_end(ahead, i, detection, line)) continue;
    left_end = true;
    line.stations.push_back(new_station(corrected, origin, detection, ahead[i], config.extension_log_odds));
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
  const double lateral_m = foot_at(line, end, detection.samples[outermost.sample]).lateral_m;
  Point step = Point::Zero();
  step.head<2>() = lateral_m * left_of(direction_at(line, end));
  if (!at_back) std::ranges::reverse(line.stations);
  extend_back(ahead, step, origin, detection, config, line);
  if (!at_back) std::ranges::reverse(line.stations);
}

}  // namespace

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
                  const LocalRange& range, const FusionConfig& config, const DetectionModel& model,
                  std::vector<Line>& lines, ElementId& next_id) {
  for (const SampledDetection& detection : detections) {
    const std::size_t count = detection.samples.size();
    for (std::size_t begin = 0; begin < count;) {
      std::size_t end = begin;
      while (end < count && !detection.explained[end] && range.keeps(detection.samples[end])) ++end;
      Line line{.stations = {}, .observations = 1, .first_seen_ns = stamp_ns, .last_seen_ns = stamp_ns};
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
        add_confidence(detection, origin, 1.0, model, line);
        lines.push_back(std::move(line));
      }
      begin = std::max(end, begin + 1);
    }
  }
}

}  // namespace laneloom
