#include "mapping/voxels/co_observation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <map>
#include <random>

namespace laneloom::voxels {
namespace {

constexpr int kVoxels = 40;

/// The paper's matrix, literally, of the detections of the last frames.
class BruteForce {
 public:
  explicit BruteForce(int remembered_frames) : remembered_frames_(remembered_frames) {}

  void begin_frame() {
    ++frame_;
    std::erase_if(detections_, [&](const Recorded& d) { return d.frame + remembered_frames_ <= frame_; });
  }
  void record(MarkingType type, const std::vector<VoxelId>& voxels) {
    Recorded recorded{frame_, type, {}};
    for (const VoxelId id : voxels) recorded.touches.set(id);
    detections_.push_back(recorded);
  }
  void erase(VoxelId id) {
    for (auto& d : detections_) d.touches.reset(id);
  }
  std::map<VoxelId, std::uint32_t> row(VoxelId id) const {
    std::map<VoxelId, std::uint32_t> counts;
    for (const auto& d : detections_) {
      for (VoxelId other = 0; other < kVoxels; ++other) {
        if (other != id && d.touches[id] && d.touches[other]) ++counts[other];
      }
    }
    return counts;
  }
  std::uint32_t count(VoxelId id, MarkingType type) const {
    return static_cast<std::uint32_t>(std::ranges::count_if(
        detections_, [&](const Recorded& d) { return d.type == type && d.touches[id]; }));
  }

 private:
  struct Recorded {
    int frame;
    MarkingType type;
    std::bitset<kVoxels> touches;
  };
  int remembered_frames_;
  int frame_ = 0;
  std::vector<Recorded> detections_;
};

std::map<VoxelId, std::uint32_t> as_map(const std::vector<CoObserved>& row) {
  std::map<VoxelId, std::uint32_t> counts;
  for (const auto& [voxel, count] : row) counts[voxel] = count;
  return counts;
}

class RandomDetections : public ::testing::TestWithParam<int> {};

TEST_P(RandomDetections, EqualsTheMatrix) {
  const int remembered_frames = GetParam();
  VoxelMap map({});
  for (int i = 0; i < kVoxels; ++i) map.find_or_allocate({i, 0, 0});
  CoObservation co_observation;
  BruteForce expected(remembered_frames);
  std::mt19937 random(7);
  std::bernoulli_distribution touches(0.3), leaves(0.02);
  std::uniform_int_distribution<int> detections(0, 3), any_type(0, 2);

  for (int frame = 0; frame < 120; ++frame) {
    co_observation.begin_frame(remembered_frames, map);
    expected.begin_frame();
    for (int d = detections(random); d > 0; --d) {
      std::vector<VoxelId> voxels;
      for (VoxelId id = 0; id < kVoxels; ++id) {
        if (touches(random)) voxels.push_back(id);
      }
      const auto type = static_cast<MarkingType>(any_type(random));
      co_observation.record(type, MarkingStyle::unknown, voxels, map);
      expected.record(type, voxels);
    }
    for (VoxelId id = 0; id < kVoxels; ++id) {
      if (!leaves(random)) continue;  // the voxel leaves, and its slot is used again at once
      const VoxelIndex index = map[id].index;
      co_observation.erase(id);
      map.erase(id);
      ASSERT_EQ(map.find_or_allocate(index), id);
      expected.erase(id);
    }
    for (VoxelId id = 0; id < kVoxels; ++id) {
      ASSERT_EQ(as_map(co_observation.row(id)), expected.row(id)) << "frame " << frame << " voxel " << id;
      for (const MarkingType type : kMarkingTypes) ASSERT_EQ(map[id].count(type), expected.count(id, type));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Memory, RandomDetections, ::testing::Values(1000, 30, 1));

TEST(CoObservation, MemoryIsBoundedWhileStandingStill) {
  VoxelMap map({});
  std::vector<VoxelId> line;
  for (int i = 0; i < kVoxels; ++i) line.push_back(map.find_or_allocate({i, 0, 0}));
  CoObservation co_observation;
  std::size_t after_a_minute = 0;
  for (int frame = 0; frame < 36000; ++frame) {
    co_observation.begin_frame(300, map);
    co_observation.record(MarkingType::laneline, MarkingStyle::solid, line, map);
    if (frame == 600) after_a_minute = co_observation.stored_entries();
  }
  EXPECT_LE(co_observation.stored_entries(), 3 * 300U * kVoxels);
  EXPECT_LE(co_observation.stored_entries(), 2 * after_a_minute);
  // n and A are forgotten alike: the ratio stays 1.
  EXPECT_EQ(map[line[0]].count(MarkingType::laneline), 300U);
  EXPECT_EQ(co_observation.row(line[0]).front().count, 300U);
}

}  // namespace
}  // namespace laneloom::voxels
