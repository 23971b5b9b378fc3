#include "bench/mapper_cost.hpp"

#include <chrono>
#include <numeric>
#include <optional>
#include <utility>

namespace laneloom::bench {

double MapperCost::allocations_per_update() const {
  if (allocations.empty()) return 0.0;
  return std::accumulate(allocations.begin(), allocations.end(), 0.0) /
         static_cast<double>(allocations.size());
}

double MapperCost::markings_per_map() const {
  return update_ms.empty() ? 0.0 : static_cast<double>(markings) / static_cast<double>(update_ms.size());
}

MapperMeter::MapperMeter(const MapperConfig& config, bool count_allocations)
    : count_allocations_(count_allocations), mapper_(config) {}

void MapperMeter::update(const io::FrameRecord& record) {
  const Eigen::Isometry3d T_map_body = transform(record.pose);
  const std::uint64_t allocated = tally_.count;
  std::optional<AllocationScope> counting;
  const auto start = std::chrono::steady_clock::now();
  if (count_allocations_) counting.emplace(tally_);
  const LocalMap& map =
      mapper_.update(record.frame, T_map_body, count_allocations_ ? nullptr : &cost_.stages);
  counting.reset();
  const auto end = std::chrono::steady_clock::now();
  cost_.update_ms.push_back(std::chrono::duration<double, std::milli>(end - start).count());
  if (count_allocations_) cost_.allocations.push_back(static_cast<double>(tally_.count - allocated));
  cost_.markings += map.markings.size();
}

MapperCost MapperMeter::take_cost() {
  cost_.heap_bytes = tally_.bytes;
  cost_.peak_heap_bytes = tally_.peak_bytes;
  return std::exchange(cost_, {});
}

MapperCost measure(const MapperConfig& config, const std::vector<experiment::SimulatedFrame>& frames) {
  MapperMeter timed(config, false), counted(config, true);
  for (const experiment::SimulatedFrame& frame : frames) timed.update(frame.record);
  for (const experiment::SimulatedFrame& frame : frames) counted.update(frame.record);
  MapperCost cost = timed.take_cost();
  const MapperCost memory = counted.take_cost();
  cost.allocations = memory.allocations;
  cost.heap_bytes = memory.heap_bytes;
  cost.peak_heap_bytes = memory.peak_heap_bytes;
  return cost;
}

}  // namespace laneloom::bench
