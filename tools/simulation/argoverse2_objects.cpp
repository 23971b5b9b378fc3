#include "simulation/argoverse2_objects.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "base/seconds.hpp"
#include "io/feather.hpp"
#include "simulation/drive.hpp"
#include "simulation/pose_table.hpp"

namespace laneloom::simulation {
namespace {

constexpr std::size_t kMaxAnnotated = 256;  // objects of a message
constexpr double kNextSweep_s = 0.15;       // sweeps are 0.1 s apart

const std::map<std::string, ObjectKind> kKindOf{{"REGULAR_VEHICLE", ObjectKind::car},
                                                {"LARGE_VEHICLE", ObjectKind::truck},
                                                {"BOX_TRUCK", ObjectKind::truck},
                                                {"TRUCK", ObjectKind::truck},
                                                {"TRUCK_CAB", ObjectKind::truck},
                                                {"BUS", ObjectKind::bus},
                                                {"SCHOOL_BUS", ObjectKind::bus},
                                                {"ARTICULATED_BUS", ObjectKind::bus},
                                                {"VEHICULAR_TRAILER", ObjectKind::trailer},
                                                {"MOTORCYCLE", ObjectKind::motorcycle},
                                                {"MOTORCYCLIST", ObjectKind::motorcycle},
                                                {"BICYCLE", ObjectKind::bicycle},
                                                {"BICYCLIST", ObjectKind::bicycle},
                                                {"WHEELED_RIDER", ObjectKind::bicycle},
                                                {"WHEELED_DEVICE", ObjectKind::bicycle},
                                                {"PEDESTRIAN", ObjectKind::pedestrian},
                                                {"OFFICIAL_SIGNALER", ObjectKind::pedestrian},
                                                {"STROLLER", ObjectKind::pedestrian},
                                                {"WHEELCHAIR", ObjectKind::pedestrian},
                                                {"RAILED_VEHICLE", ObjectKind::unknown}};

/// The columns of annotations.feather that are read.
struct Annotations {
  explicit Annotations(const std::filesystem::path& path) : Annotations(io::FeatherTable(path)) {}
  explicit Annotations(const io::FeatherTable& table)
      : stamps_ns(table.column<std::int64_t>("timestamp_ns")),
        tracks(table.column<std::string>("track_uuid")),
        categories(table.column<std::string>("category")),
        lengths_m(table.column<double>("length_m")),
        widths_m(table.column<double>("width_m")),
        heights_m(table.column<double>("height_m")) {
    for (const char* name : kPoseColumns) boxes.push_back(table.column<double>(name));
  }

  /// The object of a row; its id is not set. Throws std::runtime_error where it is none.
  TrackedObject object(std::size_t row, ObjectKind kind) const {
    PoseNumbers numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = boxes[i][row];
    const Eigen::Isometry3d box = transform(checked_pose(stamps_ns[row], numbers));
    for (const double size_m : {lengths_m[row], widths_m[row], heights_m[row]})
      if (!(size_m >= 0.0 && std::isfinite(size_m)))
        throw std::runtime_error("a size of 0 or more is expected");
    return {.kind = kind,
            .position = box * Point(0.0, 0.0, -0.5 * heights_m[row]),
            .heading = box.linear().col(0),
            .length_m = lengths_m[row],
            .width_m = widths_m[row]};
  }

  std::vector<std::int64_t> stamps_ns;
  std::vector<std::string> tracks, categories;
  std::vector<double> lengths_m, widths_m, heights_m;
  std::vector<std::vector<double>> boxes;  ///< by column
};

using Sweep = std::map<std::uint64_t, TrackedObject>;  // by id
using Sweeps = std::map<std::int64_t, Sweep>;          // by stamp
using Track = std::map<std::int64_t, TrackedObject*>;  // an object of the sweeps, by stamp

/// The objects of all rows, without their speeds.
Sweeps read_sweeps(const std::filesystem::path& file, std::int64_t first_pose_ns, std::int64_t last_pose_ns,
                   LeftOut& left_out) {
  const Annotations annotations(file);
  std::map<std::string, std::uint64_t> ids;
  Sweeps sweeps;
  for (std::size_t row = 0; row < annotations.stamps_ns.size(); ++row) {
    const auto kind = kKindOf.find(annotations.categories[row]);
    if (kind == kKindOf.end()) continue;
    try {
      const std::int64_t stamp_ns = annotations.stamps_ns[row];
      TrackedObject object = annotations.object(row, kind->second);
      if (stamp_ns < first_pose_ns || stamp_ns > last_pose_ns)
        throw std::runtime_error("a stamp between those of the poses is expected");
      object.id = ids.try_emplace(annotations.tracks[row], ids.size() + 1).first->second;
      if (!sweeps[stamp_ns].emplace(object.id, object).second)
        throw std::runtime_error("a track comes twice in a sweep");
    } catch (const std::runtime_error& error) {
      const std::string place = ": row " + std::to_string(row);
      if (left_out.strict()) throw std::runtime_error(file.string() + place + ": " + error.what());
      left_out.add(error.what(), file.filename().string() + place);
    }
  }
  return sweeps;
}

/// Sets the speeds of a track's objects. `pose_at` is T_map_body at a stamp.
template <class PoseAt>
void tell_speeds(const Track& track, PoseAt pose_at) {
  const auto place = [&](const Track::value_type& seen) {
    return Point(pose_at(seen.first) * seen.second->position);
  };
  for (auto now = track.begin(); now != track.end(); ++now) {
    const bool begins = now == track.begin() || seconds(now->first - std::prev(now)->first) > kNextSweep_s;
    const auto after = std::next(now);
    const bool ends = after == track.end() || seconds(after->first - now->first) > kNextSweep_s;
    const auto& from = begins ? *now : *std::prev(now);
    const auto& to = ends ? *now : *after;
    if (from.first == to.first) continue;
    const Point heading = pose_at(now->first).linear() * now->second->heading;
    now->second->speed_mps = (place(to) - place(from)).dot(heading) / seconds(to.first - from.first);
  }
}

void keep_nearest(std::vector<TrackedObject>& objects) {
  std::ranges::stable_sort(objects, {}, [](const TrackedObject& object) { return object.position.norm(); });
  if (objects.size() > kMaxAnnotated) objects.resize(kMaxAnnotated);
}

}  // namespace

std::optional<std::filesystem::path> annotations_in(const std::filesystem::path& log_directory) {
  for (const char* const name : {"annotations.feather", "annotations_with_ego.feather"})
    if (std::filesystem::exists(log_directory / name)) return log_directory / name;
  return std::nullopt;
}

std::vector<TrackedObjects> argoverse2_objects(const std::filesystem::path& log_directory,
                                               const std::vector<VehiclePose>& poses, LeftOut& left_out) {
  const auto file = annotations_in(log_directory);
  if (!file) return {};
  const std::int64_t start_ns = poses.front().stamp_ns;
  Sweeps sweeps = read_sweeps(*file, start_ns, poses.back().stamp_ns, left_out);
  std::map<std::uint64_t, Track> tracks;
  for (auto& [stamp_ns, sweep] : sweeps)
    for (auto& [id, object] : sweep) tracks[id][stamp_ns] = &object;
  const Drive drive = Drive::recorded(poses);
  for (const auto& [id, track] : tracks)
    tell_speeds(
        track, [&](std::int64_t stamp_ns) { return transform(drive.pose_at(seconds(stamp_ns - start_ns))); });
  std::vector<TrackedObjects> result;
  for (const auto& [stamp_ns, sweep] : sweeps) {
    TrackedObjects& objects = result.emplace_back(TrackedObjects{.stamp_ns = stamp_ns, .objects = {}});
    for (const auto& [id, object] : sweep) objects.objects.push_back(object);
    keep_nearest(objects.objects);
  }
  return result;
}

}  // namespace laneloom::simulation
