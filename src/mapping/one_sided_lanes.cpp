#include "mapping/one_sided_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/levels.hpp"

namespace laneloom {
namespace {

constexpr double kChord_m = 3.0;       // either way, for a direction without noise
constexpr double kMinAdvance = 0.3;    // of the step; less is the inside of a bend that is too tight
constexpr double kBeyondEnd_m = 10.0;  // so far before or behind a line the vehicle drives along it
constexpr double kMinAlong = 0.9;      // cosine between its heading and the line

bool is_dashed(const Marking& line, double arc_m) {
  return std::ranges::any_of(line.styles, [&](const StyleRange& style) {
    return style.style == MarkingStyle::dashed && style.range.from_m <= arc_m && arc_m <= style.range.to_m;
  });
}

/// A strip beside a line; both arcs are the line's. Not valid where it would fold.
std::vector<CrossSection> strip_beside(const MeasuredPolyline& line, bool on_left, double width_m,
                                       double step_m) {
  const Polyline points = line.resample(step_m);
  std::vector<CrossSection> strip;
  for (const Point& point : points) {
    const double arc_m =
        line.length() * static_cast<double>(strip.size()) / static_cast<double>(points.size() - 1);
    const Point along = (line.at(arc_m + kChord_m) - line.at(arc_m - kChord_m)).normalized();
    const Point out = on_left ? Point(-along.y(), along.x(), 0.0) : Point(along.y(), -along.x(), 0.0);
    const Point border = point + width_m * out;
    CrossSection section{.left_arc_m = arc_m,
                         .right_arc_m = arc_m,
                         .width_m = width_m,
                         .left = on_left ? border : point,
                         .right = on_left ? point : border,
                         .valid = true};
    if (!strip.empty()) {
      const Point& before = on_left ? strip.back().left : strip.back().right;
      section.valid = (border - before).dot(along) > kMinAdvance * step_m;
    }
    strip.push_back(section);
  }
  return strip;
}

/// One side of a line.
struct LineSide {
  std::size_t line = 0;  ///< index of the boundary
  bool on_left = false;

  const Point& border(const CrossSection& section) const { return on_left ? section.left : section.right; }
  const Point& at_line(const CrossSection& section) const { return on_left ? section.right : section.left; }
};

/// Finds the lanes, side by side of the lines.
class OneSidedLanes {
 public:
  OneSidedLanes(const std::vector<LaneBoundary>& boundaries, const std::vector<MeasuredPolyline>& measured,
                const LocalRange& range, const LaneConfig& config, TakenSpace& taken)
      : boundaries_(boundaries), measured_(measured), range_(range), config_(config), taken_(taken) {}

  void add(const LineSide& side, std::uint32_t road_section) {
    const Marking& marking = boundaries_[side.line].marking;
    if (marking.type != MarkingType::laneline || marking.status != ElementStatus::confirmed) return;
    const std::vector<CrossSection> sections = open_sections(side);
    for (std::size_t begin = 0; begin < sections.size();) {
      const auto run = next_run(sections, begin, config_);
      const Range stretch{run.front().left_arc_m, run.back().left_arc_m};
      if (stretch.length() < kMinInferredLength_m) continue;
      Polyline border, middle;
      for (const CrossSection& section : run) {
        border.push_back(side.border(section));
        middle.push_back(section.middle());
      }
      taken_.beside({marking.id, side.on_left}).push_back(stretch);
      taken_.add(middle, 0.5 * config_.assumed_width_m);
      InferredBoundary found{.marking = inferred_marking(border), .section = road_section};
      (side.on_left ? found.on_right : found.on_left)
          .emplace(InferredBoundary::Beside{.boundary = side.line, .sections = {run.begin(), run.end()}});
      found_.push_back(std::move(found));
    }
  }

  std::vector<InferredBoundary> take() { return std::move(found_); }

 private:
  std::vector<CrossSection> open_sections(const LineSide& side) const {
    const Marking& marking = boundaries_[side.line].marking;
    const MeasuredPolyline& line = measured_[side.line];
    const LaneBorder own(boundaries_[side.line], line, false, taken_.beside({marking.id, side.on_left}));
    const bool driven = is_driven_along(line, side.on_left);
    auto sections = strip_beside(line, side.on_left, config_.assumed_width_m, config_.step_m);
    for (CrossSection& section : sections) {
      section.valid = section.valid && (driven || is_dashed(marking, section.left_arc_m)) &&
                      own.is_free(section.left_arc_m) && range_.shows(side.border(section)) &&
                      !taken_.contains(section.middle()) && has_nothing_else(side, section);
    }
    return sections;
  }

  /// The vehicle is as far beside it as in a lane, on that side.
  bool is_driven_along(const MeasuredPolyline& line, bool on_left) const {
    const Eigen::Isometry3d& vehicle = range_.T_map_body();
    const Projection foot = line.project(vehicle.translation());
    const double lateral_m = on_left ? foot.lateral_m : -foot.lateral_m;
    if (lateral_m <= 0.0 || lateral_m > config_.assumed_width_m) return false;
    if (foot.distance_m > std::hypot(lateral_m, kBeyondEnd_m)) return false;
    if (!same_level(foot.foot, vehicle.translation())) return false;
    const Eigen::Vector2d heading = vehicle.linear().col(0).head<2>();
    return std::abs(line.direction(foot).dot(heading)) > kMinAlong * heading.norm();
  }

  bool has_nothing_else(const LineSide& side, const CrossSection& section) const {
    const double reach_m = 0.5 * config_.max_kerb_width_m;
    const Point &from = side.at_line(section), &border = side.border(section);
    const Point middle = from + reach_m / section.width_m * (border - from);
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      if (i == side.line) continue;
      const Projection foot = measured_[i].project(middle, reach_m);
      if (foot.inside && foot.distance_m < reach_m && same_level(foot.foot, middle)) return false;
    }
    return true;
  }

  const std::vector<LaneBoundary>& boundaries_;
  const std::vector<MeasuredPolyline>& measured_;
  const LocalRange& range_;
  const LaneConfig& config_;
  TakenSpace& taken_;
  std::vector<InferredBoundary> found_;
};

}  // namespace

std::vector<InferredBoundary> one_sided_lanes(const std::vector<RoadSection>& sections,
                                              const std::vector<LaneBoundary>& boundaries,
                                              const std::vector<MeasuredPolyline>& measured,
                                              const LocalRange& range, const LaneConfig& config,
                                              TakenSpace& taken) {
  if (config.assumed_width_m <= 0.0) return {};
  OneSidedLanes lanes(boundaries, measured, range, config, taken);
  for (std::uint32_t section = 0; section < sections.size(); ++section) {
    for (const std::size_t line : sections[section].boundaries) {
      lanes.add({line, false}, section);
      lanes.add({line, true}, section);
    }
  }
  return lanes.take();
}

}  // namespace laneloom
