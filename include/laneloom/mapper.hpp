#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
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
  /// `config` must be valid (see validate() in laneloom/config_file.hpp). `sd_map` is in the map frame.
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

  /// Forgets everything but the ids that were given out and what was learned of the networks.
  void reset();

  /// The whole state, as one value. Loading it into a mapper of the same configuration continues exactly.
  const MapperState& state() const;
  void load(MapperState state);

 private:
  MapperConfig config_;
  SdMap sd_map_;
  std::unique_ptr<MapperState> state_;
};

}  // namespace laneloom
