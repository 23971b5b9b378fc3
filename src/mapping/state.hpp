#pragma once

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <variant>

#include "laneloom/config.hpp"
#include "laneloom/mapper.hpp"
#include "laneloom/types.hpp"
#include "mapping/lanes/inferred_memory.hpp"
#include "mapping/lanes/known_lines.hpp"
#include "mapping/lanes/lane_tracks.hpp"
#include "mapping/lanes/side_strips.hpp"
#include "mapping/lanes/wished_turn.hpp"
#include "mapping/lineage.hpp"
#include "mapping/lines/line_mapper.hpp"
#include "mapping/markings/id_source.hpp"
#include "mapping/pose_jumps.hpp"
#include "mapping/topology/ego_track.hpp"
#include "mapping/topology/traffic.hpp"
#include "mapping/trails/roadside.hpp"
#include "mapping/trails/trails.hpp"
#include "mapping/voxels/voxel_mapper.hpp"

namespace laneloom {

/// The method by which markings are fused. It stays the same for a mapper's life.
// clang-tidy does not see that the moves of a std::variant of such methods throw nothing.
class Fusion {  // NOLINT(bugprone-exception-escape)
 public:
  explicit Fusion(const MapperConfig& config) {
    if (config.method == FusionMethod::voxels) method_.emplace<voxels::VoxelMapper>(config.voxel_map);
  }

  markings::FusedMarkings update(markings::ObservedFrame observed, const geometry::Scene& scene,
                                 const MapperConfig& config, markings::IdSource& ids,
                                 const markings::StageLog& log) {
    return std::visit([&](auto& method) { return method.fuse(std::move(observed), scene, config, ids, log); },
                      method_);
  }

  /// Whether a frame from this pose tells next to nothing after those before.
  bool has_seen(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) const {
    return lines() != nullptr && lines()->has_seen(frame, T_map_body);
  }

  /// The state of the method `lines` or `voxels`. Null: the mapper uses the other method.
  const lines::LineMapper* lines() const { return std::get_if<lines::LineMapper>(&method_); }
  lines::LineMapper* lines() { return std::get_if<lines::LineMapper>(&method_); }
  const voxels::VoxelMapper* voxels() const { return std::get_if<voxels::VoxelMapper>(&method_); }

  /// Throws std::runtime_error where the archive holds the other method.
  template <class Archive>
  void serialize(Archive& archive) {
    auto index = static_cast<std::uint8_t>(method_.index());
    archive(index);
    if (index != method_.index()) throw std::runtime_error("of another method of fusion");
    std::visit([&](auto& method) { archive(method); }, method_);
  }

 private:
  std::variant<lines::LineMapper, voxels::VoxelMapper> method_;
};

/// The whole knowledge of a mapper. It is a value without pointers, which can be copied, saved and loaded.
struct MapperState {  // NOLINT(bugprone-exception-escape)
  explicit MapperState(const MapperConfig& config) : fusion(config) {}

  /// The state of a mapper, as a value that a session copies.
  static const MapperState& of(const Mapper& mapper) { return *mapper.state_; }
  /// Has a mapper go on from a state.
  static void give(MapperState state, Mapper& mapper) { *mapper.state_ = std::move(state); }

  std::uint64_t frame = 0;  ///< number of fused frames
  Fusion fusion;
  lanes::InferredMemory inferred;
  lanes::LaneTracks lane_tracks;
  lanes::SideStrips side_strips;
  topology::EgoTrack ego_track;
  trails::Trails trails;
  trails::Roadside roadside;
  lanes::KnownLines driven_paths;
  topology::ObservedSide side;
  Membership published;  ///< membership in the last map
  markings::IdSource ids;
  PoseJumps pose_jumps;
  Polyline driven;  ///< places of the vehicle on its way, the last one last
  lanes::WishedTurn turn;
  LocalMap map;  ///< the last map

  /// Remembers where the vehicle is.
  void drive_through(const Point& place);

  /// Forgets what others did further from the vehicle than it will be of use.
  void keep_others_around(const Point& vehicle) {
    trails.keep_around(vehicle);
    roadside.keep_around(vehicle);
  }

  /// Moves the map with poses that have jumped by `motion`, map frame. Voxels can not be moved: they are
  /// forgotten, with the lanes between them. Trails of other vehicles are forgotten, too.
  void follow(const Eigen::Isometry3d& motion, const MapperConfig& config);

  template <class Archive>
  void serialize(Archive& archive) {
    archive(frame, fusion, inferred, lane_tracks, side_strips, ego_track, trails, roadside, driven_paths,
            side, published, ids, pose_jumps, driven, turn, map);
  }
};

}  // namespace laneloom
