#include "scene/triangles.hpp"

#include "laneloom/polyline.hpp"

namespace laneloom::scene {

std::vector<std::uint32_t> strip_triangles(const Polyline& left, const Polyline& right) {
  const std::vector<double> left_arc_m = arc_lengths(left), right_arc_m = arc_lengths(right);
  // The side that is behind, by the share of its length, goes on to its next point.
  const auto left_is_behind = [&](std::size_t l, std::size_t r) {
    if (r + 1 == right.size()) return true;
    return l + 1 < left.size() &&
           left_arc_m[l + 1] * right_arc_m.back() <= right_arc_m[r + 1] * left_arc_m.back();
  };
  std::vector<std::uint32_t> indices;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t i : {a, b, c}) indices.push_back(static_cast<std::uint32_t>(i));
  };
  const std::size_t first_right = left.size();
  for (std::size_t l = 0, r = 0; l + 1 < left.size() || r + 1 < right.size();) {
    if (left_is_behind(l, r)) {
      add(l, first_right + r, l + 1);
      ++l;
    } else {
      add(l, first_right + r, first_right + r + 1);
      ++r;
    }
  }
  return indices;
}

std::vector<std::uint32_t> convex_triangles(const Polyline& outline) {
  bool turns_left = false, turns_right = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point &a = outline[i], &b = outline[(i + 1) % outline.size()],
                &c = outline[(i + 2) % outline.size()];
    const double turn = cross((b - a).head<2>(), (c - b).head<2>());
    turns_left |= turn > 0.0;
    turns_right |= turn < 0.0;
  }
  std::vector<std::uint32_t> indices;
  if (turns_left == turns_right) return indices;
  for (std::uint32_t i = 1; i + 1 < outline.size(); ++i) indices.insert(indices.end(), {0, i, i + 1});
  return indices;
}

}  // namespace laneloom::scene
