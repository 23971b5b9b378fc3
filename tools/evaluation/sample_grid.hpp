#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "laneloom/types.hpp"
#include "mapping/geometry/point_grid.hpp"

namespace laneloom::evaluation {

/// Samples of lines, so that samples near a point are found without visiting all.
class SampleGrid {
 public:
  /// `radius_m` is the radius of all searches.
  SampleGrid(const std::vector<Polyline>& lines, double radius_m)
      : radius_m_(radius_m), lines_(lines.size()), samples_(samples_of(lines), radius_m) {}

  /// How near other samples are to one of the lines.
  struct Nearness {
    std::size_t count = 0;     ///< number of the samples that are closer than the radius
    double distances_m = 0.0;  ///< sum of their distances
  };
  /// The nearness of `samples` to each line.
  std::vector<Nearness> nearness(const Polyline& samples) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::vector<Nearness> result(lines_);
    std::vector<double> nearest_m(lines_);
    for (const Point& sample : samples) {
      std::ranges::fill(nearest_m, kNone);
      visit_near(sample, [&](std::size_t line, double distance_m) {
        nearest_m[line] = std::min(nearest_m[line], distance_m);
      });
      for (std::size_t line = 0; line < lines_; ++line) {
        if (nearest_m[line] == kNone) continue;
        ++result[line].count;
        result[line].distances_m += nearest_m[line];
      }
    }
    return result;
  }

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
  std::size_t lines_;  ///< number of lines
  geometry::PointGrid<Sample> samples_;
};

}  // namespace laneloom::evaluation
