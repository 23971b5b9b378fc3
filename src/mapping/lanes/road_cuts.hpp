#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/sd_map.hpp"
#include "mapping/boundaries/road_sections.hpp"

/// Cross-sections of a road. Ours.
namespace laneloom::lanes {

/// A boundary, where a cross-section of the road meets it.
struct Mark {
  std::size_t boundary = 0;      ///< its index
  double arc_m = 0.0;            ///< on the boundary, as it runs itself
  double lateral_m = 0.0;        ///< positive on the left of the boundary that is cut
  Point point = Point::Zero();   ///< map frame
  bool opposed = false;          ///< the boundary runs against the one that is cut
  bool is_edge = false;          ///< else it is a line
  std::optional<Side> island{};  ///< the side on which it bounds a round island, as the cut one runs
  double log_odds = 0.0;         ///< that the boundary exists
  double dashed = 0.0;           ///< -1: solid; 1: dashed; 0: unknown, or an edge

  /// Lets the boundary run the other way, seen from the one that is cut.
  void turn() {
    opposed = !opposed;
    if (island) island = opposite(*island);
  }
};

/// A cross-section through a place of one boundary. It refers to the marks.
struct RoadCut {
  std::span<const Mark> marks;                       ///< from right to left, as that boundary runs
  std::size_t own = 0;                               ///< that boundary among them
  Eigen::Vector2d ahead = Eigen::Vector2d::UnitX();  ///< as it runs
  double bend = 0.0;                                 ///< its curvature, 1/m, without sign
  int street_lanes = 0;  ///< of the street, as the SD map tells; 0: it tells nothing

  const Mark& self() const { return marks[own]; }
};

/// Cross-sections in a row, with their marks.
class RoadCuts {
 public:
  /// Makes room for so many cross-sections, with so many marks each.
  void reserve(std::size_t cuts, std::size_t marks) {
    rows_.reserve(cuts);
    marks_.reserve(cuts * marks);
  }
  /// Adds a cross-section with the mark of the boundary that is cut.
  void add(const Eigen::Vector2d& ahead, double bend, const Mark& own);
  /// Adds a mark to the last cross-section.
  void insert(const Mark& mark);
  /// Looks up the lanes of the streets that are cut.
  void look_up(const SdMap& sd_map);
  std::size_t size() const { return rows_.size(); }
  RoadCut operator[](std::size_t i) const& {
    RoadCut cut = rows_[i].cut;
    cut.marks = std::span(marks_).subspan(rows_[i].begin, rows_[i].count);
    return cut;
  }
  RoadCut operator[](std::size_t i) && = delete;  // its marks would be gone
  /// Whether a boundary runs against the one that is cut.
  bool has_opposed() const;
  /// The same cross-sections along the boundary as it runs the other way. Arc lengths stay.
  RoadCuts reversed() const;

 private:
  struct Row {
    RoadCut cut;                       ///< without its marks
    std::size_t begin = 0, count = 0;  ///< of its marks
  };
  std::vector<Row> rows_;
  std::vector<Mark> marks_;
};

/// Greatest distance between two marks of a cross-section, and between two edges, which may be a street's.
inline constexpr double kCutReach_m = 14.0, kStreetReach_m = 16.5;

/// Cross-sections of the road along a boundary, LaneConfig::step_m apart, from its begin to its end. They
/// show the boundaries beside it, and where the boundary itself runs back beside that place: it is opposed
/// there, and bounds no lane with itself, but no lane reaches across it.
RoadCuts cut_along(std::size_t boundary, const boundaries::SectionGraph& road, const LaneConfig& config);

}  // namespace laneloom::lanes
