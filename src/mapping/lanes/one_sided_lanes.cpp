#include "mapping/lanes/one_sided_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/left_of.hpp"
#include "mapping/geometry/levels.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kChord_m = 3.0;        // either way, for a direction without noise
constexpr double kMinAdvance = 0.3;     // share of the step; less is the inside of a bend that is too tight
constexpr double kStyleReach_m = 5.0;   // either way; shorter patches of another style are noise
constexpr double kMinBetween_m = 20.0;  // length of a lane with something before and behind it
constexpr double kBeyondEnd_m = 10.0;   // up to here before or behind a line, the vehicle counts as beside it
constexpr double kMinAlong = 0.9;       // cosine between its heading and the line
// Distances from the line, as shares of the lane's width.
constexpr double kDrivenFrom = 0.25, kDrivenTo = 0.75;
constexpr double kSpared = 0.75;  // up to here there must be no other lane
constexpr double kOwn = 0.8;      // share of half the room; the line itself may come as near as this

/// One side of a line.
struct OpenSide {
  std::size_t line = 0;     ///< index of the boundary
  Side side = Side::right;  ///< as the line runs

  bool is_left() const { return side == Side::left; }
  const Point& border(const CrossSection& section) const { return is_left() ? section.left : section.right; }
  const Point& at_line(const CrossSection& section) const { return is_left() ? section.right : section.left; }
};

/// Cross-sections of a strip on a side of a line. Both arc lengths are the line's. A section is not valid
/// where the strip would fold.
std::vector<CrossSection> strip_beside(const MeasuredPolyline& line, const OpenSide& side, double width_m,
                                       double step_m) {
  const Polyline points = line.resample(step_m);
  std::vector<CrossSection> strip;
  for (const Point& point : points) {
    const double arc_m =
        line.length() * static_cast<double>(strip.size()) / static_cast<double>(points.size() - 1);
    const Eigen::Vector2d along = line.chord(arc_m - kChord_m, arc_m + kChord_m);
    const Point border = geometry::beside(point, along, side.is_left() ? width_m : -width_m);
    CrossSection section{.left_arc_m = arc_m,
                         .right_arc_m = arc_m,
                         .width_m = width_m,
                         .left = side.is_left() ? border : point,
                         .right = side.is_left() ? point : border,
                         .valid = true};
    if (!strip.empty())
      section.valid = (border - side.border(strip.back())).head<2>().dot(along) > kMinAdvance * step_m;
    strip.push_back(section);
  }
  return strip;
}

/// Whether a section of a road has painted lines, which tell more about its lanes than an edge does.
bool is_marked(const boundaries::RoadSection& section, const boundaries::Boundaries& boundaries) {
  return std::ranges::any_of(section.boundaries, [&](std::size_t i) {
    return !boundaries[i].is_edge() && boundaries[i].is_confirmed();
  });
}

/// Finds the lanes on one side of a line after the other.
class OneSidedLanes {
 public:
  OneSidedLanes(const boundaries::Boundaries& boundaries, const geometry::MapBox& map_box,
                const LaneConfig& config, TakenSpace& taken)
      : boundaries_(boundaries), map_box_(map_box), config_(config), taken_(taken) {
    boxes_.reserve(boundaries.size());
    for (const boundaries::LaneBoundary& boundary : boundaries)
      boxes_.push_back(box_around(boundary.course.points()));
  }

  void add(const OpenSide& side, std::uint32_t road_section) {
    const boundaries::LaneBoundary& line = boundaries_[side.line];
    if (!line.is_confirmed() || free_length_m(side) < kMinInferredLength_m) return;
    const std::vector<std::size_t> others = others_near(side.line);
    const std::vector<CrossSection> sections = open_sections(side, others);
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, config_.max_width_variation_m);
      if (length_of(run) < kMinInferredLength_m) continue;
      if (length_of(run) < kMinBetween_m && is_gap(side, others, sections, run)) continue;
      Polyline border, middle;
      for (const CrossSection& section : run) {
        border.push_back(side.border(section));
        middle.push_back(section.middle());
      }
      taken_.add(middle, 0.5 * config_.assumed_width_m);
      InferredBoundary found{.marking = inferred_marking(border), .section = road_section};
      (side.is_left() ? found.on_right : found.on_left)
          .emplace(InferredBoundary::Beside{.boundary = side.line, .sections = {run.begin(), run.end()}});
      found_.push_back(std::move(found));
    }
  }

  std::vector<InferredBoundary> take() { return std::move(found_); }

 private:
  /// The length of the line along which no lane lies beside it.
  double free_length_m(const OpenSide& side) const {
    double free_m = boundaries_[side.line].course.length();
    for (const Stretch& lane : taken_.beside({boundaries_[side.line].marking.id, side.side}))
      free_m -= lane.length();
    return free_m;
  }

  /// Whether something else lies just before and just behind a run.
  bool is_gap(const OpenSide& side, const std::vector<std::size_t>& others,
              const std::vector<CrossSection>& sections, std::span<const CrossSection> run) const {
    const auto first = static_cast<std::size_t>(run.data() - sections.data()), end = first + run.size();
    return first > 0 && end < sections.size() && !has_nothing_else(side, others, sections[first - 1]) &&
           !has_nothing_else(side, others, sections[end]);
  }

  std::vector<CrossSection> open_sections(const OpenSide& side,
                                          const std::vector<std::size_t>& others) const {
    const boundaries::LaneBoundary& line = boundaries_[side.line];
    const Marking& marking = line.marking;
    const bool driven = is_driven_along(side);
    const auto has_dashes = [&] {
      return !line.is_edge() &&
             std::ranges::count(marking.styles, MarkingStyle::dashed, &StyleRange::style) > 0;
    };
    if (!driven && !has_dashes()) return {};
    const auto is_dashed = [&](double arc_m) {
      return markings::dashed_excess_m(marking, {arc_m - kStyleReach_m, arc_m + kStyleReach_m}) > 0.0;
    };
    auto sections = strip_beside(line.course, side, config_.assumed_width_m, config_.step_m);
    for (CrossSection& section : sections) {
      const Point &from = side.at_line(section), &border = side.border(section);
      section.valid = section.valid && (driven || is_dashed(section.left_arc_m)) && map_box_.shows(border) &&
                      !taken_.contains(section.middle()) &&
                      !taken_.contains(from + kSpared * (border - from)) &&
                      has_nothing_else(side, others, section);
    }
    return sections;
  }

  /// Whether the vehicle drives on that side of the line as in a lane.
  bool is_driven_along(const OpenSide& side) const {
    const MeasuredPolyline& line = boundaries_[side.line].course;
    const Eigen::Isometry3d& vehicle = map_box_.T_map_body();
    const Projection foot = line.project(vehicle.translation());
    const double share = (side.is_left() ? foot.lateral_m : -foot.lateral_m) / config_.assumed_width_m;
    if (share < kDrivenFrom || share > kDrivenTo) return false;
    const double beyond_end_m2 = foot.distance_m * foot.distance_m - foot.lateral_m * foot.lateral_m;
    if (beyond_end_m2 > kBeyondEnd_m * kBeyondEnd_m) return false;
    if (!geometry::same_level(foot.foot, vehicle.translation())) return false;
    const Eigen::Vector2d heading = vehicle.linear().col(0).head<2>();
    return std::abs(line.direction(foot).dot(heading)) > kMinAlong * heading.norm();
  }

  /// The boundaries that could lie in the room beside a line, the line itself included.
  std::vector<std::size_t> others_near(std::size_t line) const {
    const Box reach = box_around(boundaries_[line].course.points(), config_.max_kerb_width_m);
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < boxes_.size(); ++i)
      if (reach.intersects(boxes_[i])) others.push_back(i);
    return others;
  }

  bool has_nothing_else(const OpenSide& side, const std::vector<std::size_t>& others,
                        const CrossSection& section) const {
    const double room_m = 0.5 * config_.max_kerb_width_m;
    const Point &from = side.at_line(section), &border = side.border(section);
    const Point middle = from + room_m / section.width_m * (border - from);
    return std::ranges::none_of(others, [&](std::size_t i) {
      // The line itself may come back.
      const double reach_m = i == side.line ? kOwn * room_m : room_m;
      const Projection foot = boundaries_[i].course.project(middle, reach_m);
      return foot.inside && foot.distance_m < reach_m && geometry::same_level(foot.foot, middle);
    });
  }

  const boundaries::Boundaries& boundaries_;
  const geometry::MapBox& map_box_;
  const LaneConfig& config_;
  TakenSpace& taken_;
  std::vector<Box> boxes_;  ///< of the boundaries
  std::vector<InferredBoundary> found_;
};

}  // namespace

std::vector<InferredBoundary> one_sided_lanes(const boundaries::SectionGraph& road,
                                              const geometry::MapBox& box, const LaneConfig& config,
                                              TakenSpace& taken) {
  if (!config.one_sided_lanes) return {};
  OneSidedLanes lanes(road.boundaries, box, config, taken);
  for (std::uint32_t section = 0; section < road.sections.size(); ++section) {
    const bool marked = is_marked(road.sections[section], road.boundaries);
    for (const std::size_t line : road.sections[section].boundaries) {
      if (marked && road.boundaries[line].is_edge()) continue;
      lanes.add({line, Side::right}, section);
      lanes.add({line, Side::left}, section);
    }
  }
  return lanes.take();
}

}  // namespace laneloom::lanes
