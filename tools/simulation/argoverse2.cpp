#include "simulation/argoverse2.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>

#include "io/json_fields.hpp"
#include "laneloom/polyline.hpp"
#include "simulation/argoverse2_objects.hpp"
#include "simulation/borders.hpp"
#include "simulation/drivable_areas.hpp"
#include "simulation/pose_table.hpp"

namespace laneloom::simulation {
namespace {

using nlohmann::json;

constexpr double kJoin_m = 0.05;
constexpr double kJoinEdges_m = 1.5;  // outlines end a little before the area that adjoins
constexpr double kAlongEdge_m = 0.5;
constexpr std::int64_t kPosePeriod_ns = 10'000'000;
constexpr std::int64_t kMaxDrive_ns = 3'600'000'000'000;
constexpr int kMaxDepth = 3;  // of logs below a directory: <data set>/sensor/val/<log id>

Point xyz(const json& value) {
  return {io::required(value, "x", io::coordinate), io::required(value, "y", io::coordinate),
          io::required(value, "z", io::coordinate)};
}

Polyline xyz_line(const json& value) {
  Polyline points = io::list(value, xyz);
  if (points.size() < 2) throw io::JsonError("must have at least two points");
  return points;
}

// Mark types such as NONE, DASHED_WHITE, DOUBLE_SOLID_YELLOW, or DASHED_SOLID_YELLOW (its left line first).
std::optional<MarkingStyle> painted_style(const std::string& mark, bool left_border) {
  if (mark == "NONE") return std::nullopt;
  const std::size_t dashed = left_border ? mark.rfind("DASH") : mark.find("DASH");
  const std::size_t solid = left_border ? mark.rfind("SOLID") : mark.find("SOLID");
  if (dashed == std::string::npos && solid == std::string::npos) return MarkingStyle::unknown;
  if (dashed == std::string::npos) return MarkingStyle::solid;
  if (solid == std::string::npos) return MarkingStyle::dashed;
  // A double line has the style of its line on this lane's side: the last of a left border, the first of a
  // right one.
  return (left_border ? dashed > solid : dashed < solid) ? MarkingStyle::dashed : MarkingStyle::solid;
}

// Points in centimetres, in the direction that comes first: the same for a border and its reverse.
std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>> shape(const Polyline& points) {
  std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>> there;
  for (const Point& p : points)
    there.emplace_back(std::llround(p.x() * 100.0), std::llround(p.y() * 100.0), std::llround(p.z() * 100.0));
  auto back = there;
  std::reverse(back.begin(), back.end());
  return std::min(there, back);
}

// Reads lanes and emits the borders that neighbours share once.
class LaneReader {
 public:
  void read(const json& segment, const std::string& place, LeftOut& left_out) {
    const std::string type = io::required(segment, "lane_type", io::text);
    RoadLane lane{.id = io::required(segment, "id", io::count)};
    if (!ids_.insert(lane.id).second) throw io::JsonError("id", "is given twice");
    std::tie(lane.left, lane.left_marking) =
        border(segment, "left_lane_boundary", "left_lane_mark_type", true);
    std::tie(lane.right, lane.right_marking) =
        border(segment, "right_lane_boundary", "right_lane_mark_type", false);
    if (type == "BIKE") return;
    lane.centerline = midway(lane.left, lane.right);
    lane.in_intersection = io::required(segment, "is_intersection", io::boolean);
    io::take_or_leave_out(left_out, place, "", [&] {
      lane.successors =
          io::required(segment, "successors", [](const json& ids) { return io::list(ids, io::count); });
    });
    lanes_.push_back(std::move(lane));
  }

  // Lanes of the archive may lead out of it, or into bicycle lanes; such successors are left out.
  void finish(Road& road) && {
    std::map<ElementId, ElementId> ids;
    std::sort(lanes_.begin(), lanes_.end(), [](const RoadLane& a, const RoadLane& b) { return a.id < b.id; });
    for (RoadLane& lane : lanes_) {
      ids[lane.id] = ids.size() + 1;
      lane.id = ids[lane.id];
    }
    for (RoadLane& lane : lanes_) {
      std::erase_if(lane.successors, [&](ElementId id) { return !ids.contains(id); });
      for (ElementId& id : lane.successors) id = ids[id];
      std::sort(lane.successors.begin(), lane.successors.end());
    }
    road.lanes = std::move(lanes_);
    road.markings = std::move(markings_);
  }

 private:
  std::pair<Polyline, ElementId> border(const json& segment, const char* points_key, const char* mark_key,
                                        bool left) {
    Polyline points = io::required(segment, points_key, xyz_line);
    if (!(length(points) > 0.0)) throw io::JsonError(points_key, "has no length");
    if (!limit_.add(points)) throw io::JsonError(points_key, LengthLimit::kComplaint);
    const std::optional<MarkingStyle> style = painted_style(io::required(segment, mark_key, io::text), left);
    if (!style) return {std::move(points), kNoElement};
    const auto [known, is_new] = marking_of_.try_emplace(shape(points), markings_.size() + 1);
    if (is_new) markings_.push_back({known->second, MarkingType::laneline, *style, points});
    return {std::move(points), known->second};
  }

  LengthLimit limit_;
  std::set<ElementId> ids_;
  std::vector<RoadLane> lanes_;
  std::vector<RoadMarking> markings_;
  std::map<std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>>, ElementId> marking_of_;
};

/// Reads the members of an object, each with its place. Those that are wrong are left out.
template <typename Read>
void for_each_member(const json& archive, const std::string& key, LeftOut& left_out, Read read) {
  io::required(archive, key.c_str(), [&](const json& members) {
    if (!members.is_object()) throw io::JsonError("must be an object");
    for (const auto& [name, member] : members.items()) {
      std::string place = key;
      place.append(".").append(name);
      try {
        read(member, place);
      } catch (const io::JsonError& error) {
        if (left_out.strict()) throw error.inside(name);
        left_out.add(key + ": " + error.reason(), place);
      }
    }
    return true;
  });
}

Road read_map(const json& archive, LeftOut& left_out) {
  Road road;
  LaneReader lanes;
  for_each_member(archive, "lane_segments", left_out, [&](const json& segment, const std::string& place) {
    lanes.read(segment, place, left_out);
  });
  std::move(lanes).finish(road);
  join_markings(road, kJoin_m);
  std::vector<Polyline> areas;
  LengthLimit limit;
  for_each_member(archive, "drivable_areas", left_out, [&](const json& area, const std::string&) {
    Polyline outline = io::required(area, "area_boundary", xyz_line);
    if (!limit.add(outline)) throw io::JsonError("area_boundary", LengthLimit::kComplaint);
    areas.push_back(std::move(outline));
  });
  Road edges;
  for (Polyline& edge : outer_edges(areas))
    edges.markings.push_back(
        {edges.markings.size() + 1, MarkingType::roadedge, MarkingStyle::solid, std::move(edge)});
  join_markings(edges, kJoinEdges_m);
  for (RoadMarking& edge : edges.markings) {
    edge.id = road.markings.size() + 1;
    road.markings.push_back(std::move(edge));
  }
  attach_markings(road, MarkingType::roadedge, kAlongEdge_m);
  return road;
}

Drive resampled(std::vector<VehiclePose> poses) {
  const Drive recorded = Drive::recorded(std::move(poses));
  std::vector<VehiclePose> clean;
  const std::int64_t end_ns = recorded.poses().back().stamp_ns;
  for (std::int64_t t_ns = 0; t_ns <= end_ns; t_ns += kPosePeriod_ns)
    clean.push_back(recorded.pose_at(static_cast<double>(t_ns) * 1e-9));
  return Drive::recorded(std::move(clean));
}

/// The file of poses in a directory. None: the directory has no poses, and therefore is no log.
std::optional<std::filesystem::path> pose_table(const std::filesystem::path& directory) {
  for (const char* const ending : {".feather", ".csv"}) {
    const std::filesystem::path file = directory / (std::string("city_SE3_egovehicle") + ending);
    if (std::filesystem::exists(file)) return file;
  }
  return std::nullopt;
}

/// The file of the map of a log. None: the log has no map.
std::optional<std::filesystem::path> map_archive(const std::filesystem::path& log_directory) {
  std::error_code absent;
  std::vector<std::filesystem::path> found;
  for (const auto& directory : {log_directory / "map", log_directory}) {
    for (const auto& entry : std::filesystem::directory_iterator(directory, absent)) {
      if (entry.path().filename().string().starts_with("log_map_archive_") &&
          entry.path().extension() == ".json")
        found.push_back(entry.path());
    }
    if (!found.empty()) return *std::min_element(found.begin(), found.end());
  }
  return std::nullopt;
}

template <typename Read>
bool can_be_read(Read read) {
  try {
    read();
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// What can be read of a log: poses, a map, and whatever annotations there are; then whether there are any,
/// and the number of poses. The greater one is the more complete one. To be there is not enough: of a file
/// that is cut off, the copy in another split is needed.
std::tuple<bool, bool, bool, bool, std::size_t> content(const std::filesystem::path& log_directory) {
  LeftOut nothing_told;
  std::vector<VehiclePose> poses;
  const bool has_poses = can_be_read([&] { poses = argoverse2_poses(log_directory, nothing_told); });
  const bool has_map = can_be_read([&] { load_argoverse2(log_directory, nothing_told); });
  const bool annotations_are_sound =
      has_poses && can_be_read([&] { argoverse2_objects(log_directory, poses, nothing_told); });
  return {has_poses, has_map, annotations_are_sound, annotations_in(log_directory).has_value(), poses.size()};
}

void add_logs(const std::filesystem::path& directory, int depth, std::vector<std::filesystem::path>& logs) {
  if (pose_table(directory)) return logs.push_back(directory);
  if (depth == 0) return;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(directory, unreadable))
    if (entry.is_directory(unreadable)) add_logs(entry.path(), depth - 1, logs);
}

}  // namespace

std::vector<std::filesystem::path> argoverse2_logs(const std::filesystem::path& directory,
                                                   LeftOut& left_out) {
  std::vector<std::filesystem::path> logs;
  add_logs(directory, kMaxDepth, logs);
  if (logs.empty())
    throw std::runtime_error(directory.string() +
                             ": holds no log of Argoverse 2 (city_SE3_egovehicle.feather)");
  std::sort(logs.begin(), logs.end());
  std::map<std::filesystem::path, std::filesystem::path> taken;  // by name
  for (std::filesystem::path& log : logs) {
    const auto [known, is_new] = taken.try_emplace(log.filename(), log);
    if (is_new) continue;
    if (left_out.strict()) throw std::runtime_error(log.string() + ": is a second log of this name");
    if (content(log) > content(known->second)) std::swap(log, known->second);
    left_out.add("a second log of this name", std::filesystem::relative(log, directory).string());
  }
  logs.clear();
  for (auto& [name, log] : taken) logs.push_back(std::move(log));
  return logs;
}

std::vector<VehiclePose> argoverse2_poses(const std::filesystem::path& log_directory, LeftOut& left_out) {
  const auto file = pose_table(log_directory);
  if (!file) throw std::runtime_error(log_directory.string() + ": has no city_SE3_egovehicle.feather");
  std::vector<VehiclePose> poses = read_pose_table(*file, left_out);
  if (poses.back().stamp_ns - poses.front().stamp_ns > kMaxDrive_ns)
    throw std::runtime_error(file->string() + ": lasts longer than an hour");
  return poses;
}

Road load_argoverse2(const std::filesystem::path& log_directory, LeftOut& left_out) {
  const auto archive = map_archive(log_directory);
  if (!archive) throw std::runtime_error(log_directory.string() + ": has no map/log_map_archive_*.json");
  try {
    Road road = read_map(io::load_json(*archive), left_out);
    if (road.lanes.empty()) throw io::JsonError("has no lanes for vehicles");
    road.name = std::filesystem::weakly_canonical(log_directory).filename().string();
    road.drive = resampled(argoverse2_poses(log_directory, left_out));
    return road;
  } catch (const io::JsonError& error) {
    throw std::runtime_error(archive->string() + ": " + error.what());
  }
}

}  // namespace laneloom::simulation
