#include "mapping/markings/markings.hpp"

#include <algorithm>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/stretches.hpp"

namespace laneloom::markings {
namespace {

/// The mean of both existence probabilities, weighted by length; -1 where one of them is not estimated.
double joint_existence(const Marking& a, double a_m, const Marking& b, double b_m) {
  if (a.existence_probability < 0.0 || b.existence_probability < 0.0 || a_m + b_m <= 0.0) return -1.0;
  return (a.existence_probability * a_m + b.existence_probability * b_m) / (a_m + b_m);
}

}  // namespace

MarkingStyle voted(const StyleVotes& votes, const StyleConfig& config) {
  const double solid = votes[index(MarkingStyle::solid)], dashed = votes[index(MarkingStyle::dashed)];
  const double needed = config.min_share * (solid + dashed);
  if (solid > 0.0 && solid >= needed) return MarkingStyle::solid;
  if (dashed > 0.0 && dashed >= needed) return MarkingStyle::dashed;
  return MarkingStyle::unknown;
}

void append_style(std::vector<StyleRange>& styles, const StyleRange& next) {
  if (next.range.length() <= 0.0) return;
  if (!styles.empty() && styles.back().style == next.style) {
    styles.back().range.to_m = next.range.to_m;
  } else {
    styles.push_back(next);
  }
}

double deviation_at(const std::vector<double>& arc_m, const std::vector<double>& deviations_m, double at_m) {
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(arc_m, at_m) - arc_m.begin());
  if (after == 0) return deviations_m.front();
  if (after == arc_m.size()) return deviations_m.back();
  const double share = (at_m - arc_m[after - 1]) / (arc_m[after] - arc_m[after - 1]);
  return deviations_m[after - 1] + share * (deviations_m[after] - deviations_m[after - 1]);
}

double dashed_excess_m(const Marking& marking, const Stretch& range) {
  double excess_m = 0.0;
  for (const StyleRange& style : marking.styles) {
    const double common_m = geometry::common(style.range, range).length();
    if (common_m <= 0.0) continue;
    if (style.style == MarkingStyle::dashed) excess_m += common_m;
    if (style.style == MarkingStyle::solid) excess_m -= common_m;
  }
  return excess_m;
}

Marking slice(const Marking& marking, const Stretch& stretch) {
  Marking part = marking;
  part.points = MeasuredPolyline(marking.points).slice(stretch);
  if (!marking.lateral_stddev_m.empty()) {
    const std::vector<double> whole_m = arc_lengths(marking.points);
    part.lateral_stddev_m.clear();
    for (const double arc_m : arc_lengths(part.points))
      part.lateral_stddev_m.push_back(
          deviation_at(whole_m, marking.lateral_stddev_m, stretch.from_m + arc_m));
  }
  part.styles.clear();
  for (const auto& [range, style] : marking.styles) {
    const double from_m = std::max(range.from_m, stretch.from_m) - stretch.from_m;
    const double to_m = std::min(range.to_m, stretch.to_m) - stretch.from_m;
    append_style(part.styles, {{from_m, to_m}, style});
  }
  return part;
}

void reverse(Marking& marking) {
  const double total_m = length(marking.points);
  std::ranges::reverse(marking.points);
  std::ranges::reverse(marking.lateral_stddev_m);
  std::ranges::reverse(marking.styles);
  for (auto& [range, style] : marking.styles) range = geometry::reversed(range, total_m);
}

void append(Marking& marking, const Marking& next) {
  const double end_m = length(marking.points);
  const double next_m = length(next.points);
  const double start_m = end_m + (next.points.front() - marking.points.back()).head<2>().norm();
  marking.existence_probability = joint_existence(marking, end_m, next, next_m);
  if (next_m > end_m) marking.status = next.status;
  append_style(marking.styles, {{end_m, start_m}, MarkingStyle::unknown});
  for (const auto& [range, style] : next.styles) {
    append_style(marking.styles, {{start_m + range.from_m, start_m + range.to_m}, style});
  }
  marking.points.insert(marking.points.end(), next.points.begin(), next.points.end());
  marking.lateral_stddev_m.insert(marking.lateral_stddev_m.end(), next.lateral_stddev_m.begin(),
                                  next.lateral_stddev_m.end());
  marking.observations += next.observations;
  marking.first_seen_ns = std::min(marking.first_seen_ns, next.first_seen_ns);
  marking.last_seen_ns = std::max(marking.last_seen_ns, next.last_seen_ns);
}

}  // namespace laneloom::markings
