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
  const ElementId markings = road.markings.size();
  for (RoadMarking& marking : part.markings) {
    marking.id += markings;
    road.markings.push_back(std::move(marking));
  }
  for (RoadLane& lane : part.lanes) {
    lane.id = road.lanes.size() + 1;
    for (ElementId* const marking : {&lane.left_marking, &lane.right_marking})
      if (*marking != kNoElement) *marking += markings;
    road.lanes.push_back(std::move(lane));
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
    link_lanes(road);
    join_markings(road, kMarksMeet_m);
    for (const MarkingType type : {MarkingType::laneline, MarkingType::roadedge})
      attach_markings(road, type, kMarksMeet_m);  // of roads of a junction that lie on one another
    road.drive = Drive::along(joined_centerlines(road, long_way(road)), speed_mps);
    return road;
  } catch (const std::exception& error) {
    throw std::runtime_error(xodr_file.string() + ": " + error.what());
  }
}

}  // namespace laneloom::simulation
