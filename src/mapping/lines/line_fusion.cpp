#include "mapping/lines/line_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::lines {
namespace {

/// Whether a detection ran on a line from one matched sample to the next.
bool is_seen_through(const SampleMatch& from, const SampleMatch& to) {
  return to.sample <= from.sample + 2 && is_led_through(from, to);
}

/// The observations of a line by a detection. All are gathered before any is applied, because a station that
/// has moved would turn its neighbours' normals.
class Observations {
 public:
  Observations(const SampledDetection& detection, Line& line) : detection_(detection), line_(line) {}

  /// Gathers the observations by matched samples. Stations that are observed already are left out; the others
  /// are marked as observed.
  void gather(const std::vector<SampleMatch>& samples) {
    all_.reserve(samples.size() + 1);  // samples are no further apart than stations
    for (std::size_t i = 1; i < samples.size(); ++i) {
      const SampleMatch &a = samples[i - 1], &b = samples[i];
      if (!is_seen_through(a, b)) continue;
      // At the detection's ends, the nearest station is observed too.
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
  /// The observation of a station, interpolated between two samples that follow one another.
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

}  // namespace

void fuse_matches(const Association& association, const Viewpoint& from, const FusionConfig& config,
                  Networks& networks, std::vector<Line>& lines) {
  for (Line& line : lines)
    for (Station& station : line.stations) station.sight = Sight::out_of_view;
  for (const LineMatch& match : association.matches) {
    const SampledDetection& detection = association.detections[match.detection];
    Line& line = lines[match.line];
    Observations seen(detection, line);
    seen.gather(match.samples);
    for (const Observation& observation : seen.all()) {
      Station& station = line.stations[observation.station];
      if (config.learn) learn(observation, from, station, networks);
      observe(observation, from, station);
      station.type_votes[index(detection.type)] += from.news;
      station.style_votes[index(detection.style)] += from.news;
    }
    ++line.observations;
  }
}

}  // namespace laneloom::lines
