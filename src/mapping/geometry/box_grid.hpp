#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::geometry {

/// Finds the things that reach a place: a uniform grid, seen from above. Each cell names all the things that
/// reach into it, so that a search reads one cell. Things are no further apart than a map is wide.
template <class Thing>
class BoxGrid {
 public:
  struct Boxed {
    Eigen::AlignedBox2d box;  ///< what the thing reaches; not empty
    Thing thing;
  };

  BoxGrid(const std::vector<Boxed>& all, double cell_m) : cells_per_m_(1.0 / cell_m) {
    if (all.empty()) return;
    Eigen::AlignedBox2d bounds;
    for (const Boxed& one : all) bounds.extend(one.box);
    origin_ = bounds.min();
    size_ = cell_of(bounds.max()) + Eigen::Vector2i::Ones();
    sort(all);
    things_.reserve(all.size());
    for (const Boxed& one : all) things_.push_back(one.thing);
  }

  /// Calls `visit(thing)` for every thing that reaches a point, and for some that reach close to it, as they
  /// were given.
  template <class Visit>
  void at(const Point& point, Visit&& visit) const {
    const double x = (point.x() - origin_.x()) * cells_per_m_, y = (point.y() - origin_.y()) * cells_per_m_;
    if (!(x >= 0.0 && y >= 0.0 && x < size_.x() && y < size_.y())) return;
    const std::uint32_t* const cell = starts_.data() + cell_number(static_cast<int>(x), static_cast<int>(y));
    for (std::uint32_t i = cell[0]; i != cell[1]; ++i) visit(things_[reaching_[i]]);
  }

 private:
  /// A counting sort by cell.
  void sort(const std::vector<Boxed>& all) {
    starts_.assign(size_.cast<std::size_t>().prod() + 1, 0);
    for (const Boxed& one : all) for_each_cell(one.box, [&](std::size_t cell) { ++starts_[cell + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    reaching_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t i = 0; i < all.size(); ++i)
      for_each_cell(all[i].box, [&](std::size_t cell) { reaching_[next[cell]++] = i; });
  }

  template <class Visit>
  void for_each_cell(const Eigen::AlignedBox2d& box, Visit&& visit) const {
    const Eigen::Vector2i first = cell_of(box.min()), last = cell_of(box.max());
    for (int y = first.y(); y <= last.y(); ++y)
      for (int x = first.x(); x <= last.x(); ++x) visit(cell_number(x, y));
  }

  Eigen::Vector2i cell_of(const Eigen::Vector2d& place) const {
    return ((place - origin_) * cells_per_m_).template cast<int>();
  }
  std::size_t cell_number(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x()) + static_cast<std::size_t>(x);
  }

  double cells_per_m_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<Thing> things_;
  std::vector<std::uint32_t> starts_;    ///< per cell, the first place in `reaching_`
  std::vector<std::uint32_t> reaching_;  ///< indices of things, by cell
};

}  // namespace laneloom::geometry
