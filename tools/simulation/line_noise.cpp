#include "simulation/line_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDenseStep_m = 0.5;
constexpr std::size_t kNetworkPoints = 20;
constexpr double kNetworkStep_m = 2.5;  // at most, however long the line
constexpr double kMinLength_m = 1.0;

Eigen::Vector2d left_normal(const MeasuredPolyline& line, double arc_m) {
  const Eigen::Vector2d direction = line.direction(arc_m);
  return {-direction.y(), direction.x()};
}

// 1 at the end, 0 from `reach_m` on.
double end_weight(double from_end_m, double reach_m) {
  const double share = std::max(0.0, 1.0 - from_end_m / reach_m);
  return share * share;
}

// The line's own vertices, and points between them.
Polyline densified(const Polyline& line, double step_m) {
  Polyline out{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((line[i] - line[i - 1]).head<2>().norm() / step_m)));
    for (int k = 1; k < steps; ++k) out.push_back(line[i - 1] + (line[i] - line[i - 1]) * k / steps);
    out.push_back(line[i]);
  }
  return out;
}

std::size_t nearest_to_body(const Polyline& line) {
  const auto nearest = std::min_element(line.begin(), line.end(), [](const Point& a, const Point& b) {
    return a.head<2>().squaredNorm() < b.head<2>().squaredNorm();
  });
  return static_cast<std::size_t>(nearest - line.begin());
}

Point beyond(const Polyline& line, bool at_back, double by_m) {
  const Eigen::Vector2d direction = end_direction(line, at_back ? End::back : End::front);
  return (at_back ? line.back() : line.front()) + by_m * Point(direction.x(), direction.y(), 0.0);
}

MarkingType swapped_type(MarkingType type) {
  if (type == MarkingType::laneline) return MarkingType::roadedge;
  return type == MarkingType::roadedge ? MarkingType::laneline : type;
}

MarkingStyle other_style(MarkingStyle style) {
  if (style == MarkingStyle::solid) return MarkingStyle::dashed;
  return style == MarkingStyle::dashed ? MarkingStyle::solid : style;
}

}  // namespace

LineNoise::LineNoise(const NoiseProfile& noise, MarkingType type, double distance_m, Random& random)
    : type_(type),
      offset_(random),
      rotation_(random),
      first_swing_(random),
      last_swing_(random),
      first_shift_(random),
      last_shift_(random),
      confidence_(random),
      poor_offset_(random),
      missed_(missed_share(noise, distance_m), random),
      poor_(noise.poor_share, random),
      cut_(noise.cut_share, random),
      duplicated_(noise.duplicate_share, random),
      swapped_(noise.swapped_share, random),
      wrong_style_(noise.style_wrong_share, random),
      cut_at_(random.uniform(0.2, 0.8)),
      cut_gap_(random.uniform(0.3, 1.0)),
      duplicate_offset_(random.uniform(0.5, 1.0) * (random.chance(0.5) ? 1.0 : -1.0)) {}

double LineNoise::missed_share(const NoiseProfile& noise, double distance_m) const {
  const double share = noise.missed_share.at(index(type_));
  return std::min(0.95, share + noise.missed_share_per_m * distance_m);
}

void LineNoise::step(double dt_s, const NoiseProfile& noise, double distance_m, Random& random) {
  for (Wander* wander : {&offset_, &rotation_, &confidence_}) wander->step(dt_s, noise.line_memory_s, random);
  for (Wander* wander : {&first_swing_, &last_swing_, &first_shift_, &last_shift_})
    wander->step(dt_s, noise.end_memory_s, random);
  missed_.step(dt_s, missed_share(noise, distance_m), noise.missed_dwell_s, random);
  poor_offset_.step(dt_s, noise.poor_dwell_s, random);
  poor_.step(dt_s, noise.poor_share, noise.poor_dwell_s, random);
  cut_.step(dt_s, noise.cut_share, noise.cut_dwell_s, random);
  duplicated_.step(dt_s, noise.duplicate_share, noise.duplicate_dwell_s, random);
  swapped_.step(dt_s, noise.swapped_share, noise.swapped_dwell_s, random);
  wrong_style_.step(dt_s, noise.style_wrong_share, noise.style_wrong_dwell_s, random);
}

double LineNoise::offset_m(double range_m, const NoiseProfile& noise) const {
  // Nothing that a network would take for the line is farther off for long.
  constexpr double kMaxStddevs = 1.5;
  const double lasting = std::clamp(offset_.value(), -kMaxStddevs, kMaxStddevs);
  const double lasting_m = lasting * noise.error_factor.at(index(type_)) *
                           (noise.offset_stddev_m + noise.offset_stddev_per_m * range_m);
  if (!poor_.on()) return lasting_m;
  return lasting_m + poor_offset_.value() * (noise.poor_stddev_m + noise.poor_stddev_per_m * range_m);
}

Polyline LineNoise::displaced(const Polyline& truth, const NoiseProfile& noise, Random& random) const {
  const MeasuredPolyline measured(truth);
  Polyline line = densified(measured.points(), kDenseStep_m);
  const std::vector<double> arcs_m = arc_lengths(line);
  const double nearest_m = arcs_m[nearest_to_body(line)];
  const double flutter_m = noise.flutter_stddev_m * random.normal();
  const double slope =
      noise.error_factor.at(index(type_)) * rotation_.value() * noise.rotation_stddev_deg * kDegree;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double arc_m = arcs_m[i];
    const double range_m = line[i].head<2>().norm();
    const double left_m =
        offset_m(range_m, noise) + slope * (arc_m - nearest_m) + flutter_m +
        noise.point_stddev_m * random.normal() +
        noise.end_swing_stddev_m *
            (first_swing_.value() * end_weight(arc_m, noise.end_reach_m) +
             last_swing_.value() * end_weight(measured.length() - arc_m, noise.end_reach_m));
    line[i].head<2>() += left_m * left_normal(measured, arc_m);
  }
  return line;
}

Polyline LineNoise::with_shifted_ends(const Polyline& line, const NoiseProfile& noise) const {
  const MeasuredPolyline measured(line);
  const double max_m = 0.3 * measured.length();
  const auto shift_m = [&](const Wander& wander) {
    return std::clamp(wander.value() * noise.end_shift_stddev_m, -max_m, max_m);
  };
  const double first_m = shift_m(first_shift_), last_m = shift_m(last_shift_);  // positive: too long
  const Polyline kept = measured.slice({std::max(0.0, -first_m), measured.length() - std::max(0.0, -last_m)});
  Polyline out;
  if (first_m > 0.0) out.push_back(beyond(kept, false, first_m));
  for (const Point& p : kept) out.push_back(p);
  if (last_m > 0.0) out.push_back(beyond(kept, true, last_m));
  return out;
}

double LineNoise::confidence(const Polyline& line, const NoiseProfile& noise, Random& random) const {
  double range_m = std::numeric_limits<double>::infinity();
  for (const Point& p : line) range_m = std::min(range_m, p.head<2>().norm());
  const double error_m = std::abs(offset_m(range_m, noise));
  // Half of its scatter stays with the line, half is every frame's own.
  const double scatter = noise.confidence_stddev * std::numbers::sqrt2 / 2.0;
  return std::clamp(noise.confidence - noise.confidence_per_m * range_m -
                        noise.confidence_per_error_m * error_m +
                        scatter * (confidence_.value() + random.normal()),
                    0.02, 1.0);
}

std::vector<Detection> LineNoise::detect(const Polyline& truth, MarkingStyle style, const NoiseProfile& noise,
                                         Random& random) const {
  const Polyline whole = with_shifted_ends(displaced(truth, noise, random), noise);
  Detection detection{.type = swapped_.on() ? swapped_type(type_) : type_,
                      .style = wrong_style_.on() ? other_style(style) : style,
                      .confidence = confidence(whole, noise, random),
                      .points = whole,
                      .stddev_m = {}};
  if (random.chance(noise.style_unknown_probability)) detection.style = MarkingStyle::unknown;
  std::vector<Detection> out{detection};
  const MeasuredPolyline measured(whole);
  const double gap_m = cut_gap_ * noise.cut_gap_m, cut_m = cut_at_ * measured.length();
  if (cut_.on() && cut_m > kMinLength_m && measured.length() - cut_m - gap_m > kMinLength_m) {
    out.front().points = measured.slice({0.0, cut_m});
    out.push_back(detection);
    out.back().points = measured.slice({cut_m + gap_m, measured.length()});
  }
  if (duplicated_.on()) {
    out.push_back(detection);
    out.back().confidence = std::clamp(noise.ghost_confidence + 0.15 * random.normal(), 0.02, 1.0);
    for (Point& p : out.back().points)
      p.head<2>() +=
          duplicate_offset_ * noise.duplicate_offset_m * left_normal(measured, measured.project(p).arc_m);
  }
  return out;
}

Polyline as_network_output(const Polyline& line) {
  const MeasuredPolyline measured(line);
  return measured.resample(
      std::min(measured.length() / static_cast<double>(kNetworkPoints - 1), kNetworkStep_m));
}

void make_zigzag(Polyline& line, double stddev_m, Random& random) {
  const MeasuredPolyline measured(line);
  const std::vector<double> arc_m = arc_lengths(line);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double left_m = (i % 2 == 0 ? 1.0 : -1.0) * stddev_m * std::abs(random.normal());
    line[i].head<2>() += left_m * left_normal(measured, arc_m[i]);
  }
}

}  // namespace laneloom
