#include "mapping/lines/line_growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/geometry/left_of.hpp"
#include "mapping/lines/line_evidence.hpp"

namespace laneloom::lines {
namespace {

/// The least distance between stations. The last one may be nearer, so that a line reaches as far as it was
/// seen.
double min_spacing(bool is_last, const FusionConfig& config) {
  return is_last ? 0.5 * config.station_spacing_m : config.station_spacing_m - 0.5 * config.sample_step_m;
}

/// Extends lines by the samples of detections beyond their ends.
class Growth {
 public:
  Growth(const Viewpoint& from, const geometry::MapBox& box, const FusionConfig& config)
      : from_(from), box_(box), config_(config) {}

  void extend(const LineMatch& match, End end, SampledDetection& detection, Line& line) const {
    const auto by_index = [](const SampleMatch& s) { return s.foot.index; };
    const SampleMatch& outermost = end == End::back ? *std::ranges::max_element(match.samples, {}, by_index)
                                                    : *std::ranges::min_element(match.samples, {}, by_index);
    const std::size_t last = end == End::back ? line.stations.size() - 1 : 0;
    if (std::abs(outermost.foot.index - static_cast<double>(last)) > kMaxFromEnd) return;
    const SampleMatch& other =
        outermost.sample == match.samples.front().sample ? match.samples.back() : match.samples.front();
    const int step = outermost.sample > other.sample ? 1 : -1;
    const std::vector<std::size_t> ahead = take_following(outermost.sample, step, detection);
    if (ahead.empty()) return;
    const double lateral_m = foot_at(line, last, detection.samples[outermost.sample]).lateral_m;
    Point offset = Point::Zero();
    offset.head<2>() = lateral_m * geometry::left_of(direction_at(line, last));
    if (end == End::front) std::ranges::reverse(line.stations);
    extend_back(ahead, offset, detection, line);
    if (end == End::front) std::ranges::reverse(line.stations);
  }

 private:
  static constexpr double kMaxFromEnd = 1.5;  // stations

  /// The unexplained samples in the range that follow `from`: in the order of the detection if `step` is 1,
  /// against it if `step` is -1. Marks them as explained.
  std::vector<std::size_t> take_following(std::size_t from, int step, SampledDetection& detection) const {
    std::vector<std::size_t> ahead;
    const auto count = static_cast<std::ptrdiff_t>(detection.samples.size());
    for (auto i = static_cast<std::ptrdiff_t>(from) + step; i >= 0 && i < count; i += step) {
      const auto k = static_cast<std::size_t>(i);
      if (detection.explained[k] || !box_.keeps(detection.samples[k])) break;
      detection.explained[k] = true;
      ahead.push_back(k);
    }
    return ahead;
  }

  /// Appends stations to the back of `line` along `ahead`, the numbers of the samples that follow. The offset
  /// of the detection from the line's end fades out.
  void extend_back(const std::vector<std::size_t>& ahead, const Point& offset,
                   const SampledDetection& detection, Line& line) const {
    const Point& first = detection.samples[ahead.front()];
    bool left_end = false;
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      const Point& sample = detection.samples[ahead[i]];
      const double run_m = (sample - first).head<2>().norm();
      const Point corrected = sample - offset * std::max(0.0, 1.0 - run_m / config_.fade_m);
      const double gap_m = (corrected - line.stations.back().position).head<2>().norm();
      if (gap_m < min_spacing(i + 1 == ahead.size(), config_)) continue;
      if (!left_end && is_before_end(ahead, i, detection, line)) continue;
      left_end = true;
      line.stations.push_back(new_station(corrected, from_, detection, ahead[i], config_.extension_log_odds));
    }
  }

  /// Whether a detection with its sample `i` has not yet passed the end of `line`: the sample lies behind the
  /// end, and the detection runs on towards the end. Beyond a sharp tip a sample lies behind the end too, but
  /// the detection runs away from it.
  static bool is_before_end(const std::vector<std::size_t>& ahead, std::size_t i,
                            const SampledDetection& detection, const Line& line) {
    const Point& sample = detection.samples[ahead[i]];
    const Eigen::Vector2d direction = direction_at(line, line.stations.size() - 1);
    if ((sample - line.stations.back().position).head<2>().dot(direction) > 0.0) return false;
    if (i + 1 == ahead.size()) return true;
    return (detection.samples[ahead[i + 1]] - sample).head<2>().dot(direction) > 0.0;
  }

  const Viewpoint& from_;
  const geometry::MapBox& box_;
  const FusionConfig& config_;
};

/// The first sample from `begin` on that a line explains, or that is beyond the range.
std::size_t unexplained_end(const SampledDetection& detection, std::size_t begin,
                            const geometry::MapBox& box) {
  std::size_t end = begin;
  while (end < detection.samples.size() && !detection.explained[end] && box.keeps(detection.samples[end]))
    ++end;
  return end;
}

}  // namespace

void extend_lines(const Viewpoint& from, const geometry::MapBox& box, const FusionConfig& config,
                  Association& association, std::vector<Line>& lines) {
  const Growth growth(from, box, config);
  // The matches know the stations by number: the front ends come last, and each end is extended once.
  for (const End end : {End::back, End::front}) {
    std::vector<std::size_t> before;
    before.reserve(lines.size());
    for (const Line& line : lines) before.push_back(line.stations.size());
    for (const LineMatch& match : association.matches) {
      Line& line = lines[match.line];
      if (line.stations.size() == before[match.line])
        growth.extend(match, end, association.detections[match.detection], line);
    }
  }
}

std::vector<Line> new_lines(const std::vector<SampledDetection>& detections, const Viewpoint& from,
                            const geometry::MapBox& box, const FusionConfig& config,
                            const DetectionModel& model) {
  std::vector<Line> lines;
  for (const SampledDetection& detection : detections) {
    for (std::size_t begin = 0, end = 0; begin < detection.samples.size(); begin = std::max(end, begin + 1)) {
      end = unexplained_end(detection, begin, box);
      Line line{.stations = {}, .observations = 1};
      double length_m = 0.0;
      for (std::size_t i = begin; i < end; ++i) {
        length_m += detection.share_m(i);
        const Point& sample = detection.samples[i];
        const bool near =
            !line.stations.empty() &&
            (sample - line.stations.back().position).head<2>().norm() < min_spacing(i + 1 == end, config);
        if (!near) line.stations.push_back(new_station(sample, from, detection, i, config.birth_log_odds));
      }
      if (line.stations.size() < 2 || length_m < config.min_birth_length_m) continue;
      add_belief(detection.belief, 1.0, model, line);
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace laneloom::lines
