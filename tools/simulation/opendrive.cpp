#include "simulation/opendrive.hpp"

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulation/lanelet2_ways.hpp"
#include "simulation/map_file.hpp"
#include "simulation/opendrive_road.hpp"
#include "simulation/route.hpp"

namespace laneloom::simulation {
namespace {

constexpr double kLanesMeet_m =
    0.6;  // between the ends of lanes that follow one another, where roads bend at their joint
constexpr double kLanesMeet_cos = 0.9;  // between their directions
constexpr double kMarksMeet_m = 0.05;   // between the ends of marks

/// Adds the lanes and markings of a part, with new ids.
void append_part(Road&& part, Road& road) {
  for (RoadMarking& marking : part.markings) {
    marking.id = road.markings.size() + 1;
    road.markings.push_back(std::move(marking));
  }
  for (RoadLane& lane : part.lanes) {
    lane.id = road.lanes.size() + 1;
    road.lanes.push_back(std::move(lane));
  }
}

/// Gives each lane's borders the markings that they lie on.
void attach_markings(Road& road) {
  std::map<std::pair<double, double>, std::vector<const RoadMarking*>> ends;  // by the place of either end
  for (const RoadMarking& marking : road.markings)
    for (const Point& end : {marking.points.front(), marking.points.back()})
      ends[{end.x(), end.y()}].push_back(&marking);
  const auto marking_of = [&](const Polyline& border) {
    const auto found = ends.find({border.front().x(), border.front().y()});
    if (found == ends.end()) return kNoElement;
    const Polyline reversed(border.rbegin(), border.rend());
    for (const RoadMarking* marking : found->second)
      if (marking->points == border || marking->points == reversed) return marking->id;
    return kNoElement;
  };
  for (RoadLane& lane : road.lanes) {
    lane.left_marking = marking_of(lane.left);
    lane.right_marking = marking_of(lane.right);
  }
}

void link_lanes(Road& road) {
  const auto direction = [](const Polyline& line, bool at_end) -> Eigen::Vector2d {
    const Point step = at_end ? line.back() - line[line.size() - 2] : line[1] - line[0];
    return step.head<2>().normalized();
  };
  std::multimap<double, std::size_t> starts;  // by x
  for (std::size_t i = 0; i < road.lanes.size(); ++i) starts.emplace(road.lanes[i].centerline.front().x(), i);
  for (RoadLane& lane : road.lanes) {
    const Point& end = lane.centerline.back();
    const auto last = starts.upper_bound(end.x() + kLanesMeet_m);
    for (auto start = starts.lower_bound(end.x() - kLanesMeet_m); start != last; ++start) {
      const RoadLane& next = road.lanes[start->second];
      if (next.id != lane.id && (next.centerline.front() - end).norm() < kLanesMeet_m &&
          direction(lane.centerline, true).dot(direction(next.centerline, false)) > kLanesMeet_cos)
        lane.successors.push_back(next.id);
    }
    std::ranges::sort(lane.successors);
  }
}

}  // namespace

Road load_opendrive(const std::filesystem::path& xodr_file, double speed_mps, LeftOut& left_out) {
  try {
    const MapFile file(xodr_file, "OpenDRIVE", "a road network of OpenDRIVE (.xodr)", left_out);
    Road road;
    road.name = xodr_file.stem().string();
    LengthLimit limit;
    int balance = 0;  // of roads with right-hand traffic over the others
    std::set<std::string_view> ids;
    for_each_element(file.root(), "road", left_out, [&](const pugi::xml_node& element) {
      const std::string_view id = element.attribute("id").as_string();
      if (!id.empty() && !ids.insert(id).second) refuse(element, "is given twice");
      Road part = read_opendrive_road(element, limit);
      balance += part.right_hand_traffic ? 1 : -1;
      append_part(std::move(part), road);
    });
    if (road.lanes.empty()) throw std::runtime_error("has no lanes for vehicles");
    if (!has_lines(road))
      throw std::runtime_error("has no road marks, and no edges: nothing of it can be seen");
    road.right_hand_traffic = balance >= 0;
    attach_markings(road);
    link_lanes(road);
    join_markings(road, kMarksMeet_m);
    attach_roadedges(road, kMarksMeet_m);
    road.drive = Drive::along(joined_centerlines(road, long_way(road)), speed_mps);
    return road;
  } catch (const std::exception& error) {
    throw std::runtime_error(xodr_file.string() + ": " + error.what());
  }
}

}  // namespace laneloom::simulation
