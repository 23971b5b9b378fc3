#include "mapping/voxels/co_observation.hpp"

#include <algorithm>
#include <limits>

namespace laneloom::voxels {
namespace {

constexpr auto kNeverBorn = std::numeric_limits<std::uint64_t>::max();

}  // namespace

void CoObservation::begin_frame(int remembered_frames, VoxelMap& map) {
  ++frame_;
  const auto remembered = static_cast<std::uint64_t>(remembered_frames);
  while (!observations_.empty() && observations_.front().frame + remembered <= frame_) {
    const Observation& oldest = observations_.front();
    for (const VoxelId id : oldest.voxels) {
      if (!has_seen(id, first_)) continue;
      --map[id].detections[index(oldest.type)];
      --map[id].styles[index(oldest.style)];
    }
    observations_.pop_front();
    ++first_;
  }
}

void CoObservation::record(MarkingType type, MarkingStyle style, std::vector<VoxelId> voxels, VoxelMap& map) {
  if (seen_in_.size() < map.slots()) {
    seen_in_.resize(map.slots());
    born_.resize(map.slots(), kNeverBorn);
    counts_.resize(map.slots(), 0);
  }
  for (const VoxelId id : voxels) {
    ++map[id].detections[index(type)];
    ++map[id].styles[index(style)];
    append(id, next());
  }
  observations_.push_back({frame_, type, style, std::move(voxels)});
}

void CoObservation::append(VoxelId voxel, ObservationId observation) {
  if (born_[voxel] == kNeverBorn) born_[voxel] = observation;
  auto& seen = seen_in_[voxel];
  if (seen.size() == seen.capacity()) {  // forgotten detections are dropped before it grows
    seen.erase(seen.begin(), std::lower_bound(seen.begin(), seen.end(), first_));
  }
  seen.push_back(observation);
}

void CoObservation::erase(VoxelId id) {
  if (id >= seen_in_.size()) return;
  seen_in_[id].clear();
  born_[id] = kNeverBorn;
}

const std::vector<CoObserved>& CoObservation::row(VoxelId id) {
  counts_.resize(seen_in_.size(), 0);
  row_.clear();
  if (id >= seen_in_.size()) return row_;
  const auto& seen = seen_in_[id];
  for (auto it = std::lower_bound(seen.begin(), seen.end(), first_); it != seen.end(); ++it) {
    for (const VoxelId other : observations_[*it - first_].voxels) {
      if (other == id || !has_seen(other, *it)) continue;
      if (counts_[other]++ == 0) row_.push_back({other, 0});
    }
  }
  for (CoObserved& entry : row_) {
    entry.count = counts_[entry.voxel];
    counts_[entry.voxel] = 0;
  }
  return row_;
}

std::size_t CoObservation::stored_entries() const {
  std::size_t entries = 0;
  for (const Observation& observation : observations_) entries += observation.voxels.size();
  for (const auto& seen : seen_in_) entries += seen.size();
  return entries;
}

}  // namespace laneloom::voxels
