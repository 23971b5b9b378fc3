#include "mapping/lines/line_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/geometry/reproducible.hpp"

namespace laneloom::lines {
namespace {

// The mean belief in a line's detections adds this much per unit to the log odds that the line exists. All
// detections of a line have a share of their variance in common, so that many say little more than some.
constexpr double kPerBelief = 3.5, kCommonShare = 0.3;
constexpr double kMostAgainst = 4.0, kMostFor = 1.0;  // log odds: many wrong lines look right, too

/// Whether a polygon contains a point, by the number of its crossings of a ray (even-odd rule).
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

bool View::detects(MarkingType type) const {
  const auto& types = frame->detected_types;
  return types.empty() || std::ranges::find(types, type) != types.end();
}

bool View::unlimited() const { return frame->field_of_view.empty() && frame->occluded_areas.empty(); }

Outline::Outline(const Polyline& polygon) : polygon_(&polygon) {
  for (const Point& point : polygon) bounds_.extend(point.head<2>());
}

bool Outline::contains(const Point& point) const {
  return bounds_.contains(Eigen::Vector2d(point.head<2>())) && lines::contains(*polygon_, point);
}

View::View(const Eigen::Isometry3d& transform, const DetectionFrame& of, double weight, double least)
    : T_body_map(transform), frame(&of), news(weight), least_news(least), field_of_view_(of.field_of_view) {
  for (const Polyline& area : of.occluded_areas) occluded_areas_.emplace_back(area);
}

bool View::sees(const Point& point_map, MarkingType type, const geometry::MapBox& range) const {
  if (!detects(type)) return false;
  const Point point = T_body_map * point_map;
  const bool in_view = frame->field_of_view.empty() ? range.shows(point_map) : field_of_view_.contains(point);
  return in_view &&
         std::ranges::none_of(occluded_areas_, [&](const Outline& area) { return area.contains(point); });
}

double log_odds(const Beliefs& beliefs) {
  if (beliefs.count <= 0.0) return 0.0;
  const double variance = kCommonShare + (1.0 - kCommonShare) / std::max(1.0, beliefs.count);
  return std::clamp(kPerBelief * (beliefs.mean - kUsualBelief) / variance, -kMostAgainst, kMostFor);
}

double existence(std::span<const Station> stations, const Beliefs& beliefs) {
  double sum = 0.0;
  for (const Station& station : stations) sum += station.log_odds;
  return sum / static_cast<double>(stations.size()) + log_odds(beliefs);
}

namespace {

/// Whether a line is confirmed by its stations alone, without the beliefs in its detections.
bool is_established(const Line& line, const FusionConfig& config) {
  return existence(line.stations, {}) >= config.confirm_log_odds;
}

double hit(double belief, const FusionConfig& config) { return config.hit_log_odds * 4.0 * belief * belief; }

/// The limit up to which a standing vehicle raises the evidence: a line may come to be published, but not
/// confirmed.
double standing_limit(const FusionConfig& config) {
  return 0.5 * (config.publish_log_odds + config.confirm_log_odds);
}

/// Raises the stations that the match observed.
void credit_stations(const LineMatch& match, double log_odds, const View& view, const FusionConfig& config,
                     Line& line) {
  const auto [lowest, highest] =
      std::ranges::minmax(match.samples, {}, [](const SampleMatch& s) { return s.foot.index; });
  const auto last = static_cast<double>(line.stations.size() - 1);
  const std::size_t begin = nearest_station(std::clamp(lowest.foot.index, 0.0, last));
  const std::size_t end = nearest_station(std::clamp(highest.foot.index, 0.0, last));
  for (std::size_t k = begin; k <= end; ++k) {
    Station& station = line.stations[k];
    if (station.sight != Sight::observed) continue;
    const double standing = std::min(station.log_odds + view.least_news * log_odds, standing_limit(config));
    station.log_odds =
        std::max(std::min(station.log_odds + view.news * log_odds, config.max_log_odds), standing);
  }
}

}  // namespace

void add_belief(double belief, double news, const DetectionModel& model, Line& line) {
  if (model.knows_confidences()) line.beliefs.add(belief, news);
}

void credit_observed(const View& view, const Association& association, const FusionConfig& config,
                     DetectionModel& model, std::vector<Line>& lines) {
  for (const LineMatch& match : association.matches) {
    const SampledDetection& detection = association.detections[match.detection];
    Line& line = lines[match.line];
    line.last_seen_ns = std::max(line.last_seen_ns, view.frame->stamp_ns);
    credit_stations(match, hit(detection.belief, config), view, config, line);
    if (config.learn && view.is_independent() && is_established(line, config))
      model.learn_confidence(detection.confidence);
    add_belief(detection.belief, view.news, model, line);
  }
}

void discount_unobserved(const View& view, const geometry::MapBox& range, const FusionConfig& config,
                         DetectionModel& model, std::vector<Line>& lines) {
  for (Line& line : lines) {
    const MarkingType type = line.type();
    const bool teaches = config.learn && view.is_independent() && is_established(line, config);
    for (Station& station : line.stations) {
      const Point place = view.T_body_map * station.position;
      const bool seen = station.sight == Sight::observed;
      const bool in_view = !seen && view.sees(station.position, type, range);
      const bool could_see = seen || in_view || (view.unlimited() && view.detects(type));
      if (teaches && could_see && station.log_odds >= config.confirm_log_odds)
        model.learn_rate(type, place, seen);
      if (seen || !could_see) continue;
      if (in_view) station.sight = Sight::missed;
      const bool confirmed = station.log_odds >= config.confirm_log_odds;
      const double news = confirmed ? view.news : std::max(view.news, view.least_news);
      station.log_odds +=
          news * config.miss_log_odds * geometry::reproducible::log(1.0 - model.rate(type, place));
    }
  }
}

namespace {

/// Drops the dead stations at both ends.
template <class IsDead>
void trim(std::vector<Station>& stations, const IsDead& dead) {
  stations.erase(std::find_if_not(stations.rbegin(), stations.rend(), dead).base(), stations.end());
  stations.erase(stations.begin(), std::ranges::find_if_not(stations, dead));
}

/// The pieces of a line that are left without its dead stations, in order.
template <class IsDead>
std::vector<Line> living_pieces(Line& line, const IsDead& dead) {
  std::vector<Line> pieces;
  const std::vector<Station> stations = std::exchange(line.stations, {});
  for (auto begin = stations.begin(); begin != stations.end();) {
    const auto end = std::find_if(begin, stations.end(), dead);
    if (end - begin >= 2) {
      pieces.push_back(line);
      pieces.back().stations.assign(begin, end);
    }
    begin = std::find_if_not(end, stations.end(), dead);
  }
  return pieces;
}

}  // namespace

std::vector<markings::Relative> prune_lines(const geometry::MapBox& range, const FusionConfig& config,
                                            std::vector<Line>& lines, markings::IdSource& ids) {
  std::vector<Line> kept, cut_off;
  std::vector<markings::Relative> relatives;
  const auto dead = [&](const Station& s) {
    return s.log_odds < config.min_log_odds || !range.keeps(s.position);
  };
  kept.reserve(lines.size());
  for (Line& line : lines) {
    trim(line.stations, dead);  // most lines lose no more than an end
    if (line.stations.size() >= 2 && std::ranges::none_of(line.stations, dead)) {
      kept.push_back(std::move(line));
      continue;
    }
    std::vector<Line> pieces = living_pieces(line, dead);
    if (pieces.empty()) continue;
    const auto longest =
        std::ranges::max_element(pieces, {}, [](const Line& piece) { return piece.stations.size(); });
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
      if (piece == longest) continue;
      piece->id = ids.next();
      relatives.push_back({piece->id, line.id});
      cut_off.push_back(std::move(*piece));
    }
    kept.push_back(std::move(*longest));
  }
  lines = std::move(kept);
  std::ranges::move(cut_off, std::back_inserter(lines));
  return relatives;
}

}  // namespace laneloom::lines
