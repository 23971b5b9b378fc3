#pragma once

#include <cstddef>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/geometry/point_grid.hpp"

namespace laneloom {

/// Samples of lines, so that samples near a point are found without visiting all.
class SampleGrid {
 public:
  /// `radius_m` is the radius of all searches.
  SampleGrid(const std::vector<Polyline>& lines, double radius_m)
      : radius_m_(radius_m), samples_(samples_of(lines), radius_m) {}

  /// Calls visit(line, distance_m) for every sample closer than the radius, with the index of its line.
  template <typename Visit>
  void visit_near(const Point& point, const Visit& visit) const {
    samples_.around(point, radius_m_, [&](const Sample& sample) {
      const double distance_m = (sample.position - point.head<2>()).norm();
      if (distance_m < radius_m_) visit(sample.line, distance_m);
    });
  }

 private:
  struct Sample {
    Eigen::Vector2d position;
    std::size_t line = 0;
  };
  static std::vector<Sample> samples_of(const std::vector<Polyline>& lines) {
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const Point& point : lines[i]) samples.push_back({point.head<2>(), i});
    return samples;
  }

  double radius_m_;
  PointGrid<Sample> samples_;
};

}  // namespace laneloom
