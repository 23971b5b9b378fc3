#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "laneloom/types.hpp"

namespace laneloom {

/// A place on a line, about every metre, with what is known of the line there.
struct Station {
  Point position = Point::Zero();   ///< map frame
  double information_per_m2 = 0.0;  ///< inverse variance of the lateral position
  double closest_m = 0.0;           ///< from which it was observed
  double log_odds = 0.0;            ///< that the line exists here
  std::array<double, kMarkingStyleCount> style_votes{};

  template <class Archive>
  void serialize(Archive& archive) {
    archive(position, information_per_m2, closest_m, log_odds, style_votes);
  }
};

/// A marking that is followed over time.
struct Line {
  ElementId id = kNoElement;
  std::vector<Station> stations;  ///< in order along the line
  std::array<double, kMarkingTypeCount> type_votes{};
  std::uint64_t observations = 0;
  std::int64_t first_seen_ns = 0;

  /// The most voted type; the first one of equals.
  MarkingType type() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(id, stations, type_votes, observations, first_seen_ns);
  }
};

/// Per line and station, whether a detection of the frame observed it.
using StationsObserved = std::vector<std::vector<bool>>;

/// Lanelines and roadedges are told apart by vote, stoplines from the start: they cross the others.
inline bool is_stopline(MarkingType type) { return type == MarkingType::stopline; }

/// The foot of a point on a line.
struct StationFoot {
  double index = 0.0;      ///< of the foot between stations: 2.5 is halfway between the third and the fourth
  double lateral_m = 0.0;  ///< of the point; left of the line is positive
  double height_m = 0.0;   ///< of the point above the foot
  bool inside = false;     ///< not beyond one of the line's ends
};

/// Foot of `point` on the two segments at station `nearest`. The line has at least two stations.
StationFoot foot_at(const Line& line, std::size_t nearest, const Point& point);

/// Horizontal unit direction of the line at a station.
Eigen::Vector2d direction_at(const Line& line, std::size_t station);

/// Finds stations by place: a uniform grid over the stations of one instant.
class StationGrid {
 public:
  /// What is asked of a station again and again lies together, in the order in which it is walked.
  struct Entry {
    Point position = Point::Zero();
    std::uint32_t line = 0;
    std::uint32_t station = 0;
  };
  static constexpr double kCell_m = 2.0;  ///< no less than a gate and a station's spacing

  /// Of all stoplines, or of all other lines.
  StationGrid(const std::vector<Line>& lines, bool of_stoplines);

  /// Calls `visit(entry)` for every station within a cell of `point`, in a fixed order.
  template <class Visit>
  void around(const Point& point, Visit&& visit) const {
    if (entries_.empty()) return;
    const Eigen::Vector2i center = cell_of(point);
    const int first_x = std::max(center.x() - 1, 0), last_x = std::min(center.x() + 1, size_.x() - 1);
    const int first_y = std::max(center.y() - 1, 0), last_y = std::min(center.y() + 1, size_.y() - 1);
    if (first_x > last_x) return;
    for (int y = first_y; y <= last_y; ++y) {
      // The cells of a row follow one another.
      const Entry* const end = entries_.data() + starts_[cell_number({last_x, y}) + 1];
      for (const Entry* entry = entries_.data() + starts_[cell_number({first_x, y})]; entry != end; ++entry)
        visit(*entry);
    }
  }

 private:
  Eigen::Vector2i cell_of(const Point& point) const;
  std::size_t cell_number(const Eigen::Vector2i& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(cell.x());
  }

  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<std::uint32_t> starts_;
  std::vector<Entry> entries_;
};

}  // namespace laneloom
