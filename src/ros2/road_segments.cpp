#include "ros2/road_segments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "base/vehicle_frame.hpp"
#include "ros2/names.hpp"
#include "ros2/parts.hpp"

namespace laneloom::ros2 {
namespace {

using autoware_mapless_planning_msgs::msg::dds_::Linestring_;
using autoware_mapless_planning_msgs::msg::dds_::RoadSegments_;
using autoware_mapless_planning_msgs::msg::dds_::Segment_;

constexpr std::int32_t kNone = -1;
constexpr std::size_t kMaxSegments = 65'536;

/// The horizontal direction of a line at one of its points.
Eigen::Vector2d direction_at(const Polyline& line, std::size_t i) {
  const Point& from = line[i == 0 ? 0 : i - 1];
  const Point& to = line[std::min(i + 1, line.size() - 1)];
  return (to - from).head<2>().normalized();
}

Linestring_ to_linestring(const Polyline& line, const Eigen::Isometry3d& T_body_map) {
  Polyline local;
  for (const Point& point : line) local.push_back(T_body_map * point);
  Linestring_ to;
  for (std::size_t i = 0; i < local.size(); ++i) {
    const Eigen::Vector2d along = direction_at(local, i);
    const Eigen::AngleAxisd yaw(std::atan2(along.y(), along.x()), Point::UnitZ());
    to.poses().push_back(to_pose(local[i], Eigen::Quaterniond(yaw)));
  }
  return to;
}

/// The first lane on a side that runs the same way, so that it has this lane on its other side. Null: there
/// is none.
const Lane* neighbour(const std::map<ElementId, const Lane*>& lanes, const Lane& lane, bool left) {
  for (const Neighbour& beside : left ? lane.left_neighbours : lane.right_neighbours) {
    const auto found = lanes.find(beside.lane);
    if (found == lanes.end()) continue;
    const auto& back = left ? found->second->right_neighbours : found->second->left_neighbours;
    if (std::ranges::find(back, lane.id, &Neighbour::lane) != back.end()) return found->second;
  }
  return nullptr;
}

/// Makes the segments of one map.
class Builder {
 public:
  explicit Builder(const LocalMap& map) : map_(map), T_body_map_(map.T_map_body.inverse()) {
    for (const Lane& lane : map_.lanes) {
      if (segments_.size() == kMaxSegments) break;
      numbers_[lane.id] = static_cast<std::int32_t>(segments_.size());
      lanes_[lane.id] = &lane;
      add(lane.left, lane.right);
    }
    for (const auto& [id, lane] : lanes_) {
      auto& beside = segments_[static_cast<std::size_t>(numbers_[id])].neighboring_segment_id();
      for (const bool left : {true, false}) {
        const Lane* other = neighbour(lanes_, *lane, left);
        beside.push_back(other == nullptr ? kNone : numbers_[other->id]);
      }
    }
    for (const Linkage& linkage : map_.linkages) link(linkage);
    for (Segment_& segment : segments_)
      if (segment.successor_segment_id().empty()) segment.successor_segment_id({kNone});
  }
  std::vector<Segment_> take() { return std::move(segments_); }

 private:
  std::int32_t add(const Polyline& left, const Polyline& right) {
    Segment_ segment;
    segment.id(static_cast<std::uint16_t>(segments_.size()));
    segment.linestrings() = {to_linestring(left, T_body_map_), to_linestring(right, T_body_map_)};
    segments_.push_back(std::move(segment));
    return static_cast<std::int32_t>(segments_.size() - 1);
  }
  void continue_with(std::int32_t from, std::int32_t to) {
    segments_[static_cast<std::size_t>(from)].successor_segment_id().push_back(to);
  }
  void link(const Linkage& linkage) {
    const auto from = lanes_.find(linkage.from), to = lanes_.find(linkage.to);
    if (from == lanes_.end() || to == lanes_.end()) return;
    std::int32_t last = numbers_[linkage.from];
    if (linkage.path.size() >= 2 && segments_.size() < kMaxSegments) {
      const auto [left, right] = sides(linkage.path, from->second->width_m, to->second->width_m);
      const std::int32_t across = add(left, right);
      segments_.back().neighboring_segment_id({kNone, kNone});
      continue_with(last, across);
      last = across;
    }
    continue_with(last, numbers_[linkage.to]);
  }
  /// The lines at both sides of a path, whose width changes evenly from its beginning to its end.
  static std::array<Polyline, 2> sides(const Polyline& path, double from_m, double to_m) {
    std::array<Polyline, 2> both;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(path.size() - 1);
      const Eigen::Vector2d along = direction_at(path, i);
      const Point to_left = Point(-along.y(), along.x(), 0.0) * 0.5 * std::lerp(from_m, to_m, share);
      both[0].push_back(path[i] + to_left);
      both[1].push_back(path[i] - to_left);
    }
    return both;
  }

  const LocalMap& map_;
  Eigen::Isometry3d T_body_map_;
  std::map<ElementId, const Lane*> lanes_;
  std::map<ElementId, std::int32_t> numbers_;  ///< numbers of the lanes' segments
  std::vector<Segment_> segments_;
};

}  // namespace

RoadSegments_ to_road_segments(const PublishedMap& map) {
  RoadSegments_ to;
  to.header(to_header(map.map.stamp_ns, kBaseLink));
  to.pose(to_pose(map.map.T_map_body.translation(), Eigen::Quaterniond(map.map.T_map_body.linear())));
  to.segments(Builder(map.map).take());
  return to;
}

}  // namespace laneloom::ros2
