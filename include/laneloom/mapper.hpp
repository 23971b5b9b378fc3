#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/network_profile.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/sd_map.hpp"
#include "laneloom/stages.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

struct MapperState;  // private: of laneloom's own sessions

/// Fuses detections over time into the local lane map (paper, Sec. III).
///
/// A pure state machine: the same configuration and the same frames give the same maps, to the last bit.
/// Not thread-safe: one thread at a time.
class Mapper {
 public:
  /// The values of `config` must lie in the ranges that `laneloomd --dump-config` prints; this is not checked
  /// here. `sd_map` is in the map frame. Throws ConfigError where a profile of config.networks names a value
  /// that no network has.
  explicit Mapper(const MapperConfig& config, SdMap sd_map = {});
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Fuses one frame, seen from T_map_body, and rebuilds the local map about the newest pose so far. A frame
  /// may be older than the one before it. While the vehicle stands and no other one drives, the method
  /// `lines` fuses a frame each second; the map keeps up with the poses of the others. All values must be
  /// finite, and stddev_m has as many values as points, or none; this is not checked here. `observer` may be
  /// null.
  const LocalMap& update(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                         StageObserver* observer = nullptr);

  /// Takes what a tracker follows. T_map_body is the vehicle's pose at their stamp. The next update() uses
  /// it. Messages of one session come in the order of their stamps. All values must be finite.
  void add(const TrackedObjects& objects, const Eigen::Isometry3d& T_map_body);
  /// Takes the next turn of the vehicle's route. T_map_body is the vehicle's pose at its stamp. The ways of
  /// the maps make it, until the vehicle has turned, is past the place, or another one is told. The distance
  /// must be finite.
  void add(const NextTurn& turn, const Eigen::Isometry3d& T_map_body);

  /// The map after the last update.
  const LocalMap& map() const;

  /// Returns, by name, the values that the mapper has learned of one source's network. The list is empty
  /// where the mapper does not know the source.
  std::vector<std::pair<std::string, double>> learned(const std::string& source) const;
  /// The learned values of all sources, with their weights. A mapper whose MapperConfig::networks is set to
  /// them starts with this knowledge.
  NetworkProfiles profiles() const;

  /// Number of lines that the last update forgot because there was no room: a mapper keeps at most 256 lines
  /// with 20000 places together. The lines of the least evidence go. 0 with the voxel method.
  std::size_t lines_forgotten() const { return lines_forgotten_; }
  /// Number of detections of the last update that were left out because they zigzag (PreprocessConfig).
  std::size_t detections_zigzagging() const { return detections_zigzagging_; }
  /// Number of detections of the last update that were left out because of their confidence
  /// (PreprocessConfig).
  std::size_t detections_unsure() const { return detections_unsure_; }
  /// Whether the poses had jumped at the last update: by a step that no vehicle makes, and that the
  /// detections contradict. The map has moved with them, with its ids. The voxel method cleared it.
  bool poses_jumped() const { return poses_jumped_; }
  /// Whether other vehicles keep to the other side of the road than MapperConfig::direction says. Directions
  /// are then found without that setting.
  bool driving_side_contradicted() const;
  /// Forgets everything except which ids were given out and what was learned of the networks.
  void reset();

  /// The whole state, as bytes that are the same on every host.
  std::string save() const;
  /// Goes on from a state that was saved by a mapper of the same configuration: the maps that follow are the
  /// same to the last bit. Throws std::runtime_error where the bytes end too early, or are of another version
  /// or of another method; the mapper is unchanged then.
  void load(const std::string& bytes);

 private:
  friend struct MapperState;

  Eigen::Isometry3d follow_poses(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body);

  MapperConfig config_;
  SdMap sd_map_;
  std::unique_ptr<MapperState> state_;
  std::size_t detections_zigzagging_ = 0, detections_unsure_ = 0, lines_forgotten_ = 0;
  bool poses_jumped_ = false;
};

}  // namespace laneloom
