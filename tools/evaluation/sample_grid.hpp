#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// Samples of lines in square cells, so that samples near a point are found without visiting all.
class SampleGrid {
 public:
  struct Sample {
    Eigen::Vector2d position;
    std::size_t line = 0;  ///< index of the line that it belongs to
  };

  /// `radius_m` is the radius of all searches.
  SampleGrid(const std::vector<Polyline>& lines, double radius_m) : radius_m_(radius_m) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (const Point& point : lines[i])
        entries_.push_back({cell(point.x()), cell(point.y()), {point.head<2>(), i}});
    std::sort(entries_.begin(), entries_.end(), before);
  }

  /// Calls visit(line, distance_m) for every sample closer than the radius.
  template <typename Visit>
  void visit_near(const Point& point, const Visit& visit) const {
    const long column = cell(point.x()), row = cell(point.y());
    for (long x = column - 1; x <= column + 1; ++x) {
      auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry{x, row - 1, {}}, before);
      for (; entry != entries_.end() && entry->column == x && entry->row <= row + 1; ++entry) {
        const double distance_m = (entry->sample.position - point.head<2>()).norm();
        if (distance_m < radius_m_) visit(entry->sample.line, distance_m);
      }
    }
  }

 private:
  struct Entry {
    long column = 0;
    long row = 0;
    Sample sample;
  };
  static bool before(const Entry& a, const Entry& b) {
    return a.column != b.column ? a.column < b.column : a.row < b.row;
  }
  long cell(double coordinate) const { return static_cast<long>(std::floor(coordinate / radius_m_)); }

  double radius_m_;
  std::vector<Entry> entries_;  ///< by column, then row
};

}  // namespace laneloom
