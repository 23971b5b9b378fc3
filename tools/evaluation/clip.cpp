#include <algorithm>
#include <optional>

#include "evaluation/evaluation.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom {
namespace {

constexpr double kMinLength_m = 1.0;
constexpr double kMaxHeight_m = 3.0;

struct Fractions {
  double from = 0.0;
  double to = 1.0;
};

/// The stretch of a segment within the box (Liang and Barsky).
std::optional<Fractions> inside(const Point& from, const Point& to, const Point& low, const Point& high) {
  Fractions fractions;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double step = to[axis] - from[axis];
    if (step == 0.0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return std::nullopt;
      continue;
    }
    const double at_low = (low[axis] - from[axis]) / step, at_high = (high[axis] - from[axis]) / step;
    fractions.from = std::max(fractions.from, std::min(at_low, at_high));
    fractions.to = std::min(fractions.to, std::max(at_low, at_high));
  }
  if (fractions.from > fractions.to) return std::nullopt;
  return fractions;
}

/// Joins two pieces of a ring that end and begin at its seam.
void join_at_seam(const Polyline& line, std::vector<Polyline>& pieces) {
  if (pieces.size() < 2 || line.front() != line.back()) return;
  Polyline& first = pieces.front();
  Polyline& last = pieces.back();
  if (first.front() != line.front() || last.back() != line.back()) return;
  last.insert(last.end(), first.begin() + 1, first.end());
  pieces.erase(pieces.begin());
}

struct Box {
  Point low, high;
};

Box box(const RangeConfig& range) {
  return {Point(range.forward_min_m, -range.side_max_m, -kMaxHeight_m),
          Point(range.forward_max_m, range.side_max_m, kMaxHeight_m)};
}

}  // namespace

bool in_range(const Point& point_body, const RangeConfig& range) {
  const auto [low, high] = box(range);
  return (point_body.array() >= low.array()).all() && (point_body.array() <= high.array()).all();
}

std::vector<Polyline> clip(const Polyline& line, const RangeConfig& range) {
  const auto [low, high] = box(range);
  std::vector<Polyline> pieces;
  bool open = false;  // the last piece goes on with the next segment
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto fractions = inside(line[i], line[i + 1], low, high);
    open = open && fractions && fractions->from == 0.0;
    if (!fractions) continue;
    const Point step = line[i + 1] - line[i];
    if (!open) pieces.push_back({line[i] + fractions->from * step});
    open = fractions->to == 1.0;
    pieces.back().push_back(open ? line[i + 1] : line[i] + fractions->to * step);
  }
  join_at_seam(line, pieces);
  std::erase_if(pieces, [](const Polyline& piece) { return length(piece) < kMinLength_m; });
  return pieces;
}

}  // namespace laneloom
