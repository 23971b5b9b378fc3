#pragma once

#include <cstddef>
#include <vector>

#include "bench/allocations.hpp"
#include "experiment/drive_simulation.hpp"
#include "laneloom/config.hpp"
#include "support/stage_timer.hpp"

namespace laneloom {

/// What the updates of a mapper took.
struct MapperCost {
  StageTimer stages;
  std::vector<double> update_ms;     ///< of each update as a whole
  std::vector<double> allocations;   ///< calls of `new` in each update
  std::int64_t heap_bytes = 0;       ///< of the mapper and its map, after the last update
  std::int64_t peak_heap_bytes = 0;  ///< the most that it had, also within an update
  std::size_t markings = 0;          ///< summed over the maps

  TimeSummary update() const { return summarise(update_ms); }
  double allocations_per_update() const;
  double markings_per_map() const;
};

/// A mapper whose updates are watched: either its stages, or its allocations, as counting takes time of its
/// own.
class MapperMeter {
 public:
  /// `config` must be valid.
  MapperMeter(const MapperConfig& config, bool count_allocations);

  void update(const FrameRecord& record);
  /// Of the updates since the last call; but the heap is the mapper's since its start.
  MapperCost take_cost();

 private:
  bool count_allocations_;
  AllocationTally tally_;
  Mapper mapper_;
  MapperCost cost_;
};

/// Of a fresh mapper over all frames: one pass for the times, and one for the allocations.
MapperCost measure(const MapperConfig& config, const std::vector<SimulatedFrame>& frames);

}  // namespace laneloom
