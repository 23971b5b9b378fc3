#include "mapping/lines/line_publishing.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/line_merging.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lines {
namespace {

using Stations = std::span<const Station>;

/// The stations from the first to the last one of enough evidence. Weak stations in between are kept: either
/// they are soon seen again, or the line is cut there.
Stations published_stretch(const Line& line, const FusionConfig& config) {
  const auto enough = [&](const Station& station) { return station.log_odds >= config.extent_log_odds; };
  const auto begin = std::ranges::find_if(line.stations, enough);
  auto end = line.stations.end();
  while (end != begin && !enough(*std::prev(end))) --end;
  return {begin, end};
}

/// The stations' positions, smoothed twice with their neighbours. The ends stay unchanged.
Polyline smoothed(Stations stations) {
  Polyline points;
  points.reserve(stations.size());
  for (const Station& station : stations) points.push_back(station.position);
  for (int pass = 0; pass < 2; ++pass) {
    Point before = points.front();
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Point here = points[i];
      points[i] = 0.25 * before + 0.5 * here + 0.25 * points[i + 1];
      before = here;
    }
  }
  return points;
}

std::vector<StyleRange> styles_along(Stations stations, const Polyline& points, const StyleConfig& config) {
  const std::vector<double> arc = arc_lengths(points);
  std::vector<StyleRange> styles;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i)
    markings::append_style(styles, {{arc[i], arc[i + 1]}, markings::voted(stations[i].style_votes, config)});
  return styles;
}

/// The published deviation. It includes the network's lasting bias, which does not average out as the noise
/// of observations does.
double lateral_stddev_m(const Station& station, const FusionConfig& config) {
  return std::sqrt(config.bias_stddev_m * config.bias_stddev_m + station.lateral.variance_m2());
}

/// The published probability. It grows with the evidence from existence_at_publish to existence_at_max.
double existence_probability(double log_odds, const FusionConfig& config) {
  // Hardly any line has max_log_odds at all of its stations.
  constexpr double kSure = 5.0;
  const double span = std::max(1e-9, std::min(kSure, config.max_log_odds) - config.publish_log_odds);
  const double share = std::clamp((log_odds - config.publish_log_odds) / span, 0.0, 1.0);
  return config.existence_at_publish + share * (config.existence_at_max - config.existence_at_publish);
}

Marking as_marking(const Line& line, Stations stations, const MapperConfig& config) {
  Marking marking{.id = line.id, .type = line.type(), .points = smoothed(stations)};
  marking.lateral_stddev_m.reserve(stations.size());
  for (const Station& station : stations)
    marking.lateral_stddev_m.push_back(lateral_stddev_m(station, config.fusion));
  if (is_stopline(marking.type)) {
    marking.lateral_stddev_m = {marking.lateral_stddev_m.front(), marking.lateral_stddev_m.back()};
    marking.points = {marking.points.front(), marking.points.back()};
    marking.styles = {{{0.0, length(marking.points)}, MarkingStyle::unknown}};
  } else {
    marking.styles = styles_along(stations, marking.points, config.style);
  }
  const double log_odds = existence(stations, line.beliefs);
  const bool confirmed = log_odds >= config.fusion.confirm_log_odds;
  marking.status = confirmed ? ElementStatus::confirmed : ElementStatus::tentative;
  marking.existence_probability = existence_probability(log_odds, config.fusion);
  marking.observations = line.observations;
  marking.first_seen_ns = line.first_seen_ns;
  marking.last_seen_ns = line.last_seen_ns;
  return marking;
}

}  // namespace

std::vector<Shadow> shadows(const std::vector<Line>& lines, const markings::PairHistories& doubles,
                            const FusionConfig& config) {
  std::vector<Shadow> held_back;
  for (const markings::PairHistory& pair : doubles) {
    // Two lines that converge were seen together from the start on.
    const bool never_apart = pair.apart == 0.0 && pair.together > 0.0;
    if (never_apart || seen_together(pair)) continue;
    const auto a = std::ranges::find(lines, pair.a, &Line::id),
               b = std::ranges::find(lines, pair.b, &Line::id);
    if (a == lines.end() || b == lines.end() || a->type() != b->type()) continue;
    const bool a_is_weaker = weight(*a, config) < weight(*b, config);
    held_back.push_back(a_is_weaker ? Shadow{a->id, b->id} : Shadow{b->id, a->id});
  }
  return held_back;
}

std::vector<Marking> publish_lines(const std::vector<Line>& lines, const markings::PairHistories& doubles,
                                   const MapperConfig& config) {
  const FusionConfig& fusion = config.fusion;
  const std::vector<Shadow> held_back = shadows(lines, doubles, fusion);
  std::vector<Marking> markings;
  markings.reserve(lines.size());
  for (const Line& line : lines) {
    if (std::ranges::find(held_back, line.id, &Shadow::line) != held_back.end()) continue;
    const Stations stations = published_stretch(line, fusion);
    if (stations.size() < 2 || existence(stations, line.beliefs) < fusion.publish_log_odds) continue;
    Marking marking = as_marking(line, stations, config);
    if (length(marking.points) >= fusion.min_length_m) markings.push_back(std::move(marking));
  }
  std::ranges::sort(markings, {}, &Marking::id);
  return markings;
}

}  // namespace laneloom::lines
