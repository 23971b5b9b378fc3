#include "export/drive_lines.hpp"

#include <algorithm>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/geometry/map_box.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {
namespace {

constexpr double kMapStep_m = 2.0;   // driven between the maps that are used
constexpr double kMinCosine = 0.98;  // of the turn between two maps; with less, the later one is used
constexpr double kOverlap_m = 3.0;   // of a stretch that left the map with the rest, by which they are joined
constexpr double kLineStep_m = 0.5;

/// The lines of a map that were seen, without inferred ones.
std::vector<Marking> seen_lines(const LocalMap& map) {
  std::vector<Marking> lines;
  for (const Marking& boundary : map.boundaries)
    if (boundary.status != ElementStatus::inferred && length(boundary.points) > 0.0)
      lines.push_back(boundary);
  for (const Stopline& stopline : map.stoplines)
    if (length(stopline.marking.points) > 0.0) lines.push_back(stopline.marking);
  return lines;
}

bool is_step(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  return (to.translation() - from.translation()).norm() >= kMapStep_m ||
         from.linear().col(0).dot(to.linear().col(0)) < kMinCosine;
}

/// The stretches of a line outside of the range, each with an overlap to the inside.
std::vector<Stretch> stretches_outside(const MeasuredPolyline& line, const geometry::MapBox& range) {
  std::vector<Stretch> stretches;
  const Polyline samples = line.resample(kLineStep_m);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (range.keeps(samples[i])) continue;
    const double arc_m = line.length() * static_cast<double>(i) / static_cast<double>(samples.size() - 1);
    const Stretch around{std::max(0.0, arc_m - kOverlap_m), std::min(line.length(), arc_m + kOverlap_m)};
    if (!stretches.empty() && around.from_m <= stretches.back().to_m) {
      stretches.back().to_m = around.to_m;
    } else {
      stretches.push_back(around);
    }
  }
  return stretches;
}

/// The other lines of its type that run within kSameLine_m of a line.
std::vector<ElementId> lines_beside(const Marking& line, const std::vector<Marking>& lines) {
  const MeasuredPolyline course(line.points);
  const auto is_near = [&](const Point& point) {
    const Projection foot = course.project(point, kSameLine_m);
    return foot.inside && foot.distance_m < kSameLine_m;
  };
  std::vector<ElementId> beside;
  for (const Marking& other : lines)
    if (other.id != line.id && other.type == line.type &&
        std::ranges::any_of(MeasuredPolyline(other.points).resample(1.0), is_near))
      beside.push_back(other.id);
  return beside;
}

}  // namespace

void DriveAccumulator::keep_what_left(const LocalMap& before, const LocalMap& now) {
  const geometry::MapBox range(range_, now.T_map_body);
  const std::vector<Marking> lines = seen_lines(before);
  for (const Marking& line : lines) {
    const std::vector<Stretch> left = stretches_outside(MeasuredPolyline(line.points), range);
    if (left.empty()) continue;
    const auto keep = [&](Marking piece, std::vector<ElementId> beside) {
      drive_.pieces.push_back({std::move(piece), pass_, std::move(beside), drive_.poses.size() - 1});
    };
    if (line.type == MarkingType::stopline) {
      keep(line, {});
      continue;
    }
    for (const Stretch& stretch : left) {
      const Marking piece = markings::slice(line, stretch);
      keep(piece, lines_beside(piece, lines));
    }
  }
}

void DriveAccumulator::keep_all(const LocalMap& map) {
  const std::vector<Marking> lines = seen_lines(map);
  for (const Marking& line : lines)
    drive_.pieces.push_back({line, pass_, lines_beside(line, lines), drive_.poses.size() - 1});
}

void DriveAccumulator::add(const LocalMap& map) {
  if (before_ && !is_step(before_->T_map_body, map.T_map_body)) {
    newest_ = map;
    return;
  }
  if (before_) keep_what_left(*before_, map);
  drive_.poses.push_back(map.T_map_body);
  before_ = map;
  newest_.reset();
}

void DriveAccumulator::begin_anew() {
  if (const auto last = newest_ ? newest_ : before_) keep_all(*last);
  newest_.reset();
  before_.reset();
  ++pass_;
}

DriveLines DriveAccumulator::finish() {
  begin_anew();
  return std::move(drive_);
}

}  // namespace laneloom::exports
