#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom::geometry {

/// Finds things by place: a uniform grid, seen from above, over things that have a `position`.
template <class Entry>
class PointGrid {
 public:
  PointGrid() = default;
  /// Searches are quickest where they reach about as far as a cell.
  PointGrid(std::vector<Entry> entries, double cell_m) : cell_m_(cell_m) {
    if (entries.empty()) return;
    Eigen::AlignedBox2d bounds;
    for (const Entry& entry : entries) bounds.extend(place_of(entry));
    origin_ = bounds.min();
    while ((bounds.sizes() / cell_m_).prod() > kMaxCells) cell_m_ *= 2.0;
    size_ = (bounds.sizes() / cell_m_).array().floor().template cast<int>() + 1;
    sort(std::move(entries));
  }

  /// Calls `visit(entry)` for every entry that is within `reach_m` of `point`, and for some that are little
  /// further. The order is fixed: by cell, and within a cell as the entries were given.
  template <class Visit>
  void around(const Point& point, double reach_m, Visit&& visit) const {
    if (entries_.empty()) return;
    const Eigen::Vector2d reach(reach_m, reach_m);
    const Eigen::Vector2i first = cell_of(point.head<2>() - reach).cwiseMax(0);
    const Eigen::Vector2i last = cell_of(point.head<2>() + reach).cwiseMin(size_ - Eigen::Vector2i::Ones());
    if (first.x() > last.x()) return;
    for (int y = first.y(); y <= last.y(); ++y) {
      // The cells of a row follow one another.
      const Entry* const end = entries_.data() + starts_[cell_number({last.x(), y}) + 1];
      for (const Entry* entry = entries_.data() + starts_[cell_number({first.x(), y})]; entry != end; ++entry)
        visit(*entry);
    }
  }

 private:
  static constexpr double kMaxCells = 4.0e6;  // cells are wider over things that are scattered further

  static Eigen::Vector2d place_of(const Entry& entry) { return entry.position.template head<2>(); }

  /// A counting sort by cell. Until the entries are in place, each start is the end of its cell.
  void sort(std::vector<Entry> entries) {
    starts_.assign(size_.cast<std::size_t>().prod() + 1, 0);
    std::vector<std::size_t> cells;
    cells.reserve(entries.size());
    for (const Entry& entry : entries) {
      cells.push_back(cell_number(cell_of(place_of(entry))));
      ++starts_[cells.back()];
    }
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    entries_.resize(entries.size());
    for (std::size_t i = entries.size(); i-- > 0;) entries_[--starts_[cells[i]]] = entries[i];
  }

  /// Clamped, so that a far place does not overflow. Truncated, since a place before the first cell may count
  /// as in it; adding one first would round the end of the last cell up to the cell beyond.
  Eigen::Vector2i cell_of(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d cells = (place - origin_) / cell_m_;
    return cells.cwiseMax(0.0).cwiseMin(size_.cast<double>()).template cast<int>();
  }
  std::size_t cell_number(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(cell.x());
  }

  double cell_m_ = 1.0;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<std::uint32_t> starts_;  ///< per cell, the index of its first entry
  std::vector<Entry> entries_;         ///< in the order in which they are visited
};

}  // namespace laneloom::geometry
