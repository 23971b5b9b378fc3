#include "export/single_borders.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::exports {
namespace {

constexpr double kMinPart_m = 0.5;

/// The arc lengths between which a lane has one border on each side.
std::vector<double> joints(const Lane& lane) {
  const double length_m = length(lane.centerline);
  std::vector<double> joints_m;
  for (const Side side : kSides)
    for (const Border& border : lane.borders(side)) joints_m.push_back(border.range.from_m);
  std::ranges::sort(joints_m);
  std::vector<double> apart_m{0.0};
  for (const double arc_m : joints_m)
    if (arc_m - apart_m.back() >= kMinPart_m && length_m - arc_m >= kMinPart_m) apart_m.push_back(arc_m);
  apart_m.push_back(length_m);
  return apart_m;
}

/// The part of a border's boundary beside a stretch of the centerline, by scaling.
Stretch part_of(const Border& border, const Stretch& stretch) {
  const double scale = border.on_boundary.length() / border.range.length();
  const auto at = [&](double arc_m) {
    const double along_m =
        scale * (std::clamp(arc_m, border.range.from_m, border.range.to_m) - border.range.from_m);
    return border.reversed ? border.on_boundary.to_m - along_m : border.on_boundary.from_m + along_m;
  };
  const auto [from_m, to_m] = std::minmax({at(stretch.from_m), at(stretch.to_m)});
  return {from_m, to_m};
}

class Cutter {
 public:
  explicit Cutter(LocalMap& map) : map_(map) {
    for (const Marking& boundary : map.boundaries) last_id_ = std::max(last_id_, boundary.id);
    for (const Stopline& stopline : map.stoplines) last_id_ = std::max(last_id_, stopline.marking.id);
    for (const Lane& lane : map.lanes) last_id_ = std::max(last_id_, lane.id);
  }

  void cut_all() {
    std::vector<Lane> parts;
    std::map<ElementId, ElementId> last_part;
    for (const Lane& lane : map_.lanes) last_part[lane.id] = cut(lane, parts);
    for (Linkage& linkage : map_.linkages) linkage.from = last_part.at(linkage.from);
    for (Stopline& stopline : map_.stoplines)
      for (ElementId& lane : stopline.lanes) lane = last_part.at(lane);
    std::ranges::move(between_parts_, std::back_inserter(map_.linkages));
    map_.lanes = std::move(parts);
  }

 private:
  /// Appends the parts of a lane. Returns the id of the last one.
  ElementId cut(const Lane& lane, std::vector<Lane>& parts) {
    const std::vector<double> at_m = joints(lane);
    ElementId id = lane.id;
    for (std::size_t i = 0; i + 1 < at_m.size(); ++i) {
      if (i > 0) {
        between_parts_.push_back({.from = id, .to = ++last_id_, .turn = Linkage::Turn::straight, .path = {}});
        id = last_id_;
      }
      parts.push_back(part(lane, {at_m[i], at_m[i + 1]}));
      parts.back().id = id;
    }
    return id;
  }

  Lane part(const Lane& lane, const Stretch& stretch) {
    const MeasuredPolyline centerline(lane.centerline);
    Lane part = lane;
    part.left_neighbours.clear();
    part.right_neighbours.clear();
    part.centerline = centerline.slice(stretch);
    for (const Side side : kSides) {
      Polyline& line = side == Side::left ? part.left : part.right;
      const MeasuredPolyline whole(line);
      const auto beside_m = [&](double arc_m) {
        if (arc_m <= 0.0) return 0.0;
        return arc_m >= centerline.length() ? whole.length() : whole.project(centerline.at(arc_m)).arc_m;
      };
      line = whole.slice({beside_m(stretch.from_m), beside_m(stretch.to_m)});
      part.borders(side) = {border_of(lane, side, stretch, line)};
    }
    return part;
  }

  Border border_of(const Lane& lane, Side side, const Stretch& stretch, const Polyline& line) {
    const Stretch whole{0.0, stretch.length()};
    const Border* border = lane.border_at(side, 0.5 * (stretch.from_m + stretch.to_m));
    if (border != nullptr) return {border->boundary, whole, part_of(*border, stretch), border->reversed};
    const Stretch all{0.0, length(line)};
    map_.boundaries.push_back({.id = ++last_id_,
                               .status = ElementStatus::inferred,
                               .points = line,
                               .styles = {{all, MarkingStyle::unknown}},
                               .lateral_stddev_m = {}});
    return {last_id_, whole, all, false};
  }

  LocalMap& map_;
  ElementId last_id_ = kNoElement;
  std::vector<Linkage> between_parts_;
};

}  // namespace

LocalMap with_single_borders(LocalMap map) {
  Cutter(map).cut_all();
  return map;
}

}  // namespace laneloom::exports
