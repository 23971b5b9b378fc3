#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/network_profile.hpp"
#include "laneloom/sd_map.hpp"
#include "laneloom/stages.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

struct MapperState;

/// Fuses detections over time into the local lane map (paper, Sec. III).
///
/// A pure state machine: the same configuration and the same frames give the same maps, to the last bit.
/// Not thread-safe: one thread at a time.
class Mapper {
 public:
  /// `config` must be valid (see validate() in config/config_file.hpp). `sd_map` is in the map frame. Throws
  /// ConfigError where a profile of config.networks names a value that no network has.
  explicit Mapper(const MapperConfig& config, SdMap sd_map = {});
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Fuses one frame, seen from T_map_body, and rebuilds the local map about the newest pose so far. A frame
  /// may be older than the one before it. Values are finite; whoever takes them from outside checks that
  /// first. `observer` may be null.
  const LocalMap& update(const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body,
                         StageObserver* observer = nullptr);

  /// The map after the last update.
  const LocalMap& map() const;

  /// Returns, by name, the values that the mapper has learned of one source's network, as standard deviations
  /// by range. The list is empty where the mapper does not know the source.
  std::vector<std::pair<std::string, double>> learned(const std::string& source) const;
  /// The same of all sources, with what each value is worth: MapperConfig::networks of a mapper that starts
  /// with it.
  NetworkProfiles profiles() const;

  /// Forgets everything but the ids that were given out and what was learned of the networks.
  void reset();

  /// The whole state, as bytes that are the same on every host.
  std::string save() const;
  /// Goes on from a state that was saved by a mapper of the same configuration: the maps that follow are the
  /// same to the last bit. Throws std::runtime_error where the bytes end too early, or are of another version
  /// or of another method; the mapper then is as it was.
  void load(const std::string& bytes);

  /// The same as a value, for laneloom's own sessions: the type is complete in src/mapping/state.hpp.
  const MapperState& state() const;
  void set_state(MapperState state);  ///< goes on from such a value

 private:
  MapperConfig config_;
  SdMap sd_map_;
  std::unique_ptr<MapperState> state_;
};

}  // namespace laneloom
