#include "mapping/markings/dashes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/markings/chains.hpp"

namespace laneloom::markings {
namespace {

constexpr double kMaxDash_m = 9.0;      // the longest dashes are painted shorter, but may be seen too long
constexpr double kMaxGap_m = 13.0;      // the longest gaps that are painted
constexpr double kMaxLateral_m = 0.5;   // of an end from an arc that leaves the other one,
constexpr double kMaxBow_m = 1.5;       // which leads so far from the extension: a bend
constexpr double kMaxAngle_deg = 20.0;  // a dash of a metre hardly tells its direction
constexpr std::size_t kMinDashes = 3;   // two may be pieces of one solid line

bool is_dash(const ObservedMarking& marking) { return length(marking.points) <= kMaxDash_m; }

/// An end of a laneline that may continue beyond a gap.
struct Tip {
  LineEnd id;
  bool of_dash = false;
  Point place = Point::Zero();
  Eigen::Vector2d leaving = Eigen::Vector2d::Zero();  ///< unit direction, away from the line
};

std::vector<Tip> tips_of(const std::vector<ObservedMarking>& markings) {
  std::vector<Tip> tips;
  tips.reserve(2 * markings.size());
  for (std::size_t i = 0; i < markings.size(); ++i) {
    const ObservedMarking& marking = markings[i];
    if (marking.type != MarkingType::laneline || marking.style == MarkingStyle::solid) continue;
    const bool of_dash = is_dash(marking);
    for (const End end : kEnds)
      tips.push_back({{i, end}, of_dash, end_point(marking.points, end), end_direction(marking.points, end)});
  }
  return tips;
}

/// Whether two ends face each other. The angles to the gap between them tell that, too, but not where the
/// ends meet.
bool are_aligned(const Tip& a, const Tip& b) {
  return a.leaving.dot(b.leaving) <= -cos_degrees(2.0 * kMaxAngle_deg);
}

/// Whether the gap from one end to another is that of a line that goes on straight, or as an arc: from such a
/// line's ends, the gap leads to different sides by the same angle.
bool goes_on(const Tip& a, const Tip& b) {
  const Eigen::Vector2d gap = (b.place - a.place).head<2>();
  const double least = cos_degrees(kMaxAngle_deg) * gap.norm();
  if (a.leaving.dot(gap) < least || b.leaving.dot(-gap) < least) return false;
  const double from_a_m = cross(a.leaving, gap), from_b_m = cross(b.leaving, -gap);
  return std::abs(from_a_m + from_b_m) <= 2.0 * kMaxLateral_m &&
         std::abs(from_a_m - from_b_m) <= 2.0 * kMaxBow_m;
}

std::vector<Join> possible_joins(const std::vector<ObservedMarking>& markings) {
  const std::vector<Tip> tips = tips_of(markings);
  std::vector<Join> joins;
  for (auto a = tips.begin(); a != tips.end(); ++a) {
    for (auto b = a + 1; b != tips.end(); ++b) {
      if (a->id.line == b->id.line || (!a->of_dash && !b->of_dash)) continue;
      const Eigen::Vector2d gap = (b->place - a->place).head<2>();
      if (gap.squaredNorm() > kMaxGap_m * kMaxGap_m || !geometry::same_level(a->place, b->place)) continue;
      if (are_aligned(*a, *b) && goes_on(*a, *b)) joins.push_back({gap.norm(), a->id, b->id});
    }
  }
  return joins;
}

ObservedMarking joined(const std::vector<Link>& chain, std::vector<ObservedMarking>& markings) {
  ObservedMarking line{.type = MarkingType::laneline, .number = markings[chain.front().line].number};
  double doubt = 1.0, sum = 0.0;
  std::size_t dashes = 0;
  bool has_stddev = true;
  for (const Link& link : chain) {
    ObservedMarking& piece = markings[link.line];
    if (link.reversed) {
      std::ranges::reverse(piece.points);
      std::ranges::reverse(piece.stddev_m);
    }
    sum += piece.confidence;
    doubt *= 1.0 - piece.belief;
    if (is_dash(piece)) ++dashes;
    if (piece.style == MarkingStyle::dashed || dashes >= kMinDashes) line.style = MarkingStyle::dashed;
    has_stddev = has_stddev && !piece.stddev_m.empty();
    line.points.insert(line.points.end(), piece.points.begin(), piece.points.end());
    line.stddev_m.insert(line.stddev_m.end(), piece.stddev_m.begin(), piece.stddev_m.end());
  }
  if (!has_stddev) line.stddev_m.clear();
  line.confidence = sum / static_cast<double>(chain.size());
  line.belief = 1.0 - doubt;
  return line;
}

}  // namespace

std::vector<ObservedMarking> join_dashes(std::vector<ObservedMarking> markings) {
  std::vector<Join> joins = possible_joins(markings);
  if (joins.empty()) return markings;
  std::vector<ObservedMarking> result;
  result.reserve(markings.size());
  for (const std::vector<Link>& chain : chains(std::move(joins), markings.size()))
    result.push_back(chain.size() == 1 ? std::move(markings[chain.front().line]) : joined(chain, markings));
  return result;
}

}  // namespace laneloom::markings
