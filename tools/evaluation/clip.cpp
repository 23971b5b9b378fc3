#include <vector>

#include "evaluation/evaluation.hpp"
#include "laneloom/polyline.hpp"
#include "mapping/geometry/clip_segment.hpp"

namespace laneloom::evaluation {
namespace {

constexpr double kMinLength_m = 1.0;
constexpr double kMaxHeight_m = 3.0;

/// Joins two pieces of a ring that end and begin at its seam.
void join_at_seam(const Polyline& line, std::vector<Polyline>& pieces) {
  if (pieces.size() < 2 || line.front() != line.back()) return;
  Polyline& first = pieces.front();
  Polyline& last = pieces.back();
  if (first.front() != line.front() || last.back() != line.back()) return;
  last.insert(last.end(), first.begin() + 1, first.end());
  pieces.erase(pieces.begin());
}

Eigen::AlignedBox3d box(const RangeConfig& range) {
  return {Point(range.forward_min_m, -range.side_max_m, -kMaxHeight_m),
          Point(range.forward_max_m, range.side_max_m, kMaxHeight_m)};
}

}  // namespace

bool in_range(const Point& point_body, const RangeConfig& range) { return box(range).contains(point_body); }

std::vector<Polyline> clip(const Polyline& line, const RangeConfig& range) {
  const Eigen::AlignedBox3d inside = box(range);
  std::vector<Polyline> pieces;
  bool open = false;  // the last piece goes on with the next segment
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto part = geometry::clip_segment(line[i], line[i + 1], inside);
    open = open && part && part->from == 0.0;
    if (!part) continue;
    const Point step = line[i + 1] - line[i];
    if (!open) pieces.push_back({line[i] + part->from * step});
    open = part->to == 1.0;
    pieces.back().push_back(open ? line[i + 1] : line[i] + part->to * step);
  }
  join_at_seam(line, pieces);
  std::erase_if(pieces, [](const Polyline& piece) { return length(piece) < kMinLength_m; });
  return pieces;
}

}  // namespace laneloom::evaluation
