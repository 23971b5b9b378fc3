#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "io/json_fields.hpp"
#include "io/text_file.hpp"
#include "simulation/borders.hpp"
#include "simulation/road.hpp"

namespace laneloom::simulation {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "laneloom-truth";
constexpr std::uint64_t kVersion = 1;

json to_json(const VehiclePose& pose) {
  const Point& p = pose.position;
  const Eigen::Quaterniond& q = pose.orientation;
  return {static_cast<double>(pose.stamp_ns) * 1e-9, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

json to_json(const RoadMarking& marking) {
  return {{"id", marking.id},
          {"type", name(marking.type)},
          {"style", name(marking.style)},
          {"points", io::polyline_json(marking.points)}};
}

json to_json(const RoadLane& lane) {
  return {{"id", lane.id},
          {"left", io::polyline_json(lane.left)},
          {"right", io::polyline_json(lane.right)},
          {"centerline", io::polyline_json(lane.centerline)},
          {"left_marking", lane.left_marking},
          {"right_marking", lane.right_marking},
          {"in_intersection", lane.in_intersection},
          {"successors", lane.successors}};
}

template <typename T>
json all_to_json(const std::vector<T>& items) {
  json out = json::array();
  for (const T& item : items) out.push_back(to_json(item));
  return out;
}

VehiclePose pose(const json& value) {
  if (!value.is_array() || value.size() != 8) throw io::JsonError("must be [t, x, y, z, qx, qy, qz, qw]");
  const double t_s = io::number(value[0]);
  if (!(t_s >= 0.0 && t_s < 1e9)) throw io::JsonError("must have a time of 0 or more");
  return {.stamp_ns = static_cast<std::int64_t>(std::llround(t_s * 1e9)),
          .position = {io::coordinate(value[1]), io::coordinate(value[2]), io::coordinate(value[3])},
          .orientation = io::quaternion(value, 4)};
}

/// A reader of lines, which refuses them once they are too long in sum.
auto lines_within(LengthLimit& limit) {
  return [&limit](const json& value) {
    Polyline points = io::line(value);
    if (!limit.add(points)) throw io::JsonError(LengthLimit::kComplaint);
    return points;
  };
}

RoadMarking marking(const json& value, LengthLimit& limit) {
  return {.id = io::required(value, "id", io::count),
          .type = io::required(value, "type", io::marking_type),
          .style = io::required(value, "style", io::marking_style),
          .points = io::required(value, "points", lines_within(limit))};
}

/// Limits on a road's borders and centerlines. Every road that an importer accepts is within them.
struct LaneLimits {
  LengthLimit borders, centerlines;
};

RoadLane lane(const json& value, LaneLimits& limits) {
  return {.id = io::required(value, "id", io::count),
          .left = io::required(value, "left", lines_within(limits.borders)),
          .right = io::required(value, "right", lines_within(limits.borders)),
          .centerline = io::required(value, "centerline", lines_within(limits.centerlines)),
          .left_marking = io::required(value, "left_marking", io::count),
          .right_marking = io::required(value, "right_marking", io::count),
          .in_intersection = io::required(value, "in_intersection", io::boolean),
          .successors =
              io::required(value, "successors", [](const json& ids) { return io::list(ids, io::count); })};
}

template <typename T>
std::set<ElementId> ids_of(const std::vector<T>& items, const char* key) {
  std::set<ElementId> ids;
  for (const T& item : items) {
    if (item.id == kNoElement) throw io::JsonError(key, "the id 0 is none");
    if (!ids.insert(item.id).second)
      throw io::JsonError(key, "the id " + std::to_string(item.id) + " is given twice");
  }
  return ids;
}

bool right_hand(const json& value) {
  const std::string side = io::text(value);
  if (side != "right" && side != "left") throw io::JsonError("must be right or left");
  return side == "right";
}

Drive drive(const json& value) {
  try {
    return Drive::recorded(io::list(value, pose));
  } catch (const std::invalid_argument& error) {
    throw io::JsonError(error.what());
  }
}

Road road(const json& value) {
  if (io::required(value, "format", io::text) != kFormat)
    throw io::JsonError("format", "must be laneloom-truth");
  if (io::required(value, "version", io::count) != kVersion) throw io::JsonError("version", "must be 1");
  Road road;
  road.name = io::required(value, "name", io::text);
  road.right_hand_traffic = io::required(value, "driving_side", right_hand);
  LengthLimit of_markings;
  LaneLimits of_lanes;
  const auto read_marking = [&](const json& item) { return marking(item, of_markings); };
  const auto read_lane = [&](const json& item) { return lane(item, of_lanes); };
  road.markings =
      io::required(value, "markings", [&](const json& items) { return io::list(items, read_marking); });
  road.lanes = io::required(value, "lanes", [&](const json& items) { return io::list(items, read_lane); });
  road.drive = io::required(value, "drive", drive);
  check_references(road);
  return road;
}

}  // namespace

void check_references(const Road& road) {
  const std::set<ElementId> markings = ids_of(road.markings, "markings");
  const std::set<ElementId> lanes = ids_of(road.lanes, "lanes");
  const auto check = [](bool known, const RoadLane& lane, ElementId id) {
    if (known) return;
    throw io::JsonError(
        "lanes", "lane " + std::to_string(lane.id) + " refers to the unknown id " + std::to_string(id));
  };
  for (const RoadLane& lane : road.lanes) {
    for (const ElementId id : {lane.left_marking, lane.right_marking})
      check(id == kNoElement || markings.contains(id), lane, id);
    for (const ElementId id : lane.successors) check(lanes.contains(id), lane, id);
  }
}

void save_truth(const std::filesystem::path& path, const Road& road) {
  const json truth{{"format", kFormat},
                   {"version", kVersion},
                   {"name", road.name},
                   {"driving_side", road.right_hand_traffic ? "right" : "left"},
                   {"markings", all_to_json(road.markings)},
                   {"lanes", all_to_json(road.lanes)},
                   {"drive", all_to_json(road.drive.poses())}};
  io::write_text(path, truth.dump() + "\n");
}

Road load_truth(const std::filesystem::path& path) {
  try {
    return road(io::load_json(path));
  } catch (const io::JsonError& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

}  // namespace laneloom::simulation
