#pragma once

#include <cstddef>
#include <vector>

#include "bench/allocations.hpp"
#include "experiment/drive_simulation.hpp"
#include "laneloom/config.hpp"
#include "support/stage_timer.hpp"

namespace laneloom::bench {

inline constexpr double kBytesPerMB = 1024.0 * 1024.0;

/// The cost of the updates of a mapper.
struct MapperCost {
  support::StageTimer stages;
  std::vector<double> update_ms;     ///< of each update as a whole
  std::vector<double> allocations;   ///< calls of `new` in each update
  std::int64_t heap_bytes = 0;       ///< of the mapper and its map, after the last update
  std::int64_t peak_heap_bytes = 0;  ///< largest heap, also within an update
  std::size_t markings = 0;          ///< sum over the maps

  TimeSummary update() const { return support::summarise(update_ms); }
  double allocations_per_update() const;
  double markings_per_map() const;
};

/// Measures the updates of a mapper: either the times of its stages, or its allocations, because counting
/// takes time itself.
class MapperMeter {
 public:
  /// `config` must be valid.
  MapperMeter(const MapperConfig& config, bool count_allocations);

  void update(const io::FrameRecord& record);
  /// The cost of the updates since the last call. The heap counts since the mapper's start.
  MapperCost take_cost();

 private:
  bool count_allocations_;
  AllocationTally tally_;
  Mapper mapper_;
  MapperCost cost_;
};

/// The cost of a fresh mapper over all frames: one pass for the times, and one for the allocations.
MapperCost measure(const MapperConfig& config, const std::vector<experiment::SimulatedFrame>& frames);

}  // namespace laneloom::bench
