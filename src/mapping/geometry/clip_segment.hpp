#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

namespace laneloom::geometry {

/// A part of a segment, as shares of its length.
struct SegmentPart {
  double from = 0.0;
  double to = 1.0;
};

/// The part of the segment a..b that lies in a box (Liang and Barsky's clipping). Empty: the segment is
/// outside of the box, or only touches it.
template <int kDimensions>
std::optional<SegmentPart> clip_segment(const Eigen::Matrix<double, kDimensions, 1>& a,
                                        const Eigen::Matrix<double, kDimensions, 1>& b,
                                        const Eigen::AlignedBox<double, kDimensions>& box) {
  SegmentPart part;
  for (Eigen::Index axis = 0; axis < kDimensions; ++axis) {
    const double delta = b[axis] - a[axis];
    if (delta == 0.0) {
      if (a[axis] < box.min()[axis] || a[axis] > box.max()[axis]) return std::nullopt;
      continue;
    }
    const double at_min = (box.min()[axis] - a[axis]) / delta;
    const double at_max = (box.max()[axis] - a[axis]) / delta;
    part.from = std::max(part.from, std::min(at_min, at_max));
    part.to = std::min(part.to, std::max(at_min, at_max));
  }
  if (part.from >= part.to) return std::nullopt;
  return part;
}

}  // namespace laneloom::geometry
