#include "simulation/line_noise.hpp"

#include <algorithm>
#include <cmath>

#include "base/degree.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/left_of.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kDenseStep_m = 0.5;
constexpr std::size_t kNetworkPoints = 20;
constexpr double kNetworkStep_m = 2.5;  // greatest distance between points, also of long lines
constexpr double kMinPiece_m = 1.0;

Eigen::Vector2d left_normal(const MeasuredPolyline& line, double arc_m) {
  return geometry::left_of(line.direction(arc_m));
}

// A weight that is 1 at the end, and 0 from `reach_m` on.
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
  const End end = at_back ? End::back : End::front;
  const Eigen::Vector2d direction = end_direction(line, end);
  return end_point(line, end) + by_m * Point(direction.x(), direction.y(), 0.0);
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

void shift_left(Polyline& line, double left_m) {
  const MeasuredPolyline measured(line);
  const std::vector<double> arcs_m = arc_lengths(line);
  for (std::size_t i = 0; i < line.size(); ++i)
    line[i].head<2>() += left_m * left_normal(measured, arcs_m[i]);
}

double confidence_error(const NoiseProfile& noise, const Wander& held, Random& random) {
  return noise.confidence_stddev * (std::sqrt(noise.confidence_held) * held.value() +
                                    std::sqrt(1.0 - noise.confidence_held) * random.normal());
}

LineNoise::DefectState::DefectState(const Defect& defect, Trait trait, Random& random)
    : trait_(trait), moment_(defect.share * (1.0 - defect.lasting), random) {}

void LineNoise::DefectState::step(double dt_s, const Defect& defect, Random& random) {
  moment_.step(dt_s, defect.share * (1.0 - defect.lasting), defect.dwell_s, random);
}

bool LineNoise::DefectState::lasts(const Defect& defect, const Places& places, double arc_m) const {
  return places.among(defect.share * defect.lasting, trait_, arc_m);
}

bool LineNoise::DefectState::on(const Defect& defect, const Places& places, double arc_m) const {
  return moment_.on() || lasts(defect, places, arc_m);
}

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
      poor_(noise.poor, Trait::poor, random),
      cut_(noise.cut, Trait::cut, random),
      duplicated_(noise.duplicate, Trait::duplicated, random),
      swapped_(noise.swapped, Trait::swapped, random),
      wrong_style_(noise.style_wrong, Trait::style, random),
      cut_at_(random.uniform(0.2, 0.8)),
      cut_gap_(random.uniform(0.3, 1.0)) {}

double LineNoise::missed_share(const NoiseProfile& noise, double distance_m) const {
  const double share = noise.missed_share.at(index(type_)) * (1.0 - noise.missed_lasting.at(index(type_)));
  return std::min(0.95, share + noise.missed_share_per_m * distance_m);
}

void LineNoise::step(double dt_s, const NoiseProfile& noise, double distance_m, Random& random) {
  for (Wander* wander : {&offset_, &rotation_}) wander->step(dt_s, noise.line_memory_s, random);
  for (Wander* wander : {&first_swing_, &last_swing_, &first_shift_, &last_shift_})
    wander->step(dt_s, noise.end_memory_s, random);
  confidence_.step(dt_s, noise.confidence_memory_s, random);
  poor_offset_.step(dt_s, noise.poor.dwell_s, random);
  missed_.step(dt_s, missed_share(noise, distance_m), noise.missed_dwell_s, random);
  poor_.step(dt_s, noise.poor, random);
  cut_.step(dt_s, noise.cut, random);
  duplicated_.step(dt_s, noise.duplicate, random);
  swapped_.step(dt_s, noise.swapped, random);
  wrong_style_.step(dt_s, noise.style_wrong, random);
}

double LineNoise::offset_m(double range_m, double arc_m, const NoiseProfile& noise,
                           const Places& places) const {
  // A network does not take a detection that is farther off for the line for long.
  static constexpr double kMaxStddevs = 1.5;
  constexpr double kFar_m = 30.0;
  const auto bounded = [](double value) { return std::clamp(value, -kMaxStddevs, kMaxStddevs); };
  double error = std::sqrt(1.0 - noise.offset_lasting) * bounded(offset_.value());
  if (noise.offset_lasting > 0.0)
    error += std::sqrt(noise.offset_lasting) * bounded(places.wave(Trait::offset, arc_m));
  const double share = range_m / kFar_m;
  const double offset_m = error * noise.error_factor.at(index(type_)) *
                          (noise.offset_stddev_m + noise.offset_stddev_per_m * range_m +
                           noise.offset_stddev_far_m * share * share);
  if (!poor_.on(noise.poor, places, arc_m)) return offset_m;
  const double poor =
      poor_.lasts(noise.poor, places, arc_m) ? places.wave(Trait::poor_offset, arc_m) : poor_offset_.value();
  return offset_m + poor * (noise.poor_stddev_m + noise.poor_stddev_per_m * range_m);
}

Polyline LineNoise::displaced(const VisiblePiece& truth, const NoiseProfile& noise, const Places& places,
                              Random& random) const {
  const MeasuredPolyline measured(truth.points);
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
        offset_m(range_m, truth.arc.from_m + arc_m, noise, places) + slope * (arc_m - nearest_m) + flutter_m +
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

std::vector<LineNoise::Seen> LineNoise::detect(const VisiblePiece& truth, MarkingStyle style,
                                               const NoiseProfile& noise, const Places& places,
                                               Random& random) const {
  const Point& nearest = truth.points[nearest_to_body(truth.points)];
  const double range_m = nearest.head<2>().norm();
  const double arc_m = truth.arc.from_m + MeasuredPolyline(truth.points).project(nearest).arc_m;
  const Polyline whole = with_shifted_ends(displaced(truth, noise, places, random), noise);
  Detection detection{
      .type = swapped_.on(noise.swapped, places, arc_m) ? swapped_type(type_) : type_,
      .style = wrong_style_.on(noise.style_wrong, places, arc_m) ? other_style(style) : style,
      .confidence = noise.confidence - noise.confidence_per_m * range_m -
                    noise.confidence_per_error_m * std::abs(offset_m(range_m, arc_m, noise, places)) +
                    confidence_error(noise, confidence_, random),
      .points = whole,
      .stddev_m = {}};
  if (random.chance(noise.style_unknown_probability)) detection.style = MarkingStyle::unknown;
  std::vector<Seen> out{{detection, true}};
  const MeasuredPolyline measured(whole);
  const double gap_m = cut_gap_ * noise.cut_gap_m, cut_m = cut_at_ * measured.length();
  if (cut_.on(noise.cut, places, arc_m) && cut_m > kMinPiece_m &&
      measured.length() - cut_m - gap_m > kMinPiece_m) {
    out.front().detection.points = measured.slice({0.0, cut_m});
    out.push_back({detection, true});
    out.back().detection.points = measured.slice({cut_m + gap_m, measured.length()});
  }
  if (duplicated_.on(noise.duplicate, places, arc_m)) {
    const double side = 2.0 * places.uniform(Trait::duplicate_side, arc_m) - 1.0;
    detection.confidence = noise.ghost_confidence + confidence_error(noise, confidence_, random);
    shift_left(detection.points, std::copysign(0.5 + 0.5 * std::abs(side), side) * noise.duplicate_offset_m);
    out.push_back({std::move(detection), false});
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

}  // namespace laneloom::simulation
