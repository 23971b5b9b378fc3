#include "mapping/voxels/voxel_map.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace laneloom::voxels {
namespace {

TEST(VoxelMap, IndicesAreFloors) {
  const VoxelMap map({.voxel_size_m = 0.2, .voxel_height_m = 0.5});
  EXPECT_EQ(map.index_of({0.1, 0.3, 0.4}), VoxelIndex(0, 1, 0));
  EXPECT_EQ(map.index_of({-0.1, -0.3, -0.6}), VoxelIndex(-1, -2, -2));
}

TEST(VoxelMap, CentersLieInTheMiddle) {
  VoxelMap map({.voxel_size_m = 0.2, .voxel_height_m = 0.5});
  const VoxelId id = map.find_or_allocate({-1, 2, 3});
  EXPECT_TRUE(map.center(map[id]).isApprox(Point(-0.1, 0.5, 1.75)));
}

TEST(VoxelMap, BridgeAndRoadBelowAreApart) {
  VoxelMap map({});
  const VoxelId road = map.find_or_allocate(map.index_of({1, 1, 0.1}));
  const VoxelId bridge = map.find_or_allocate(map.index_of({1, 1, 6.1}));
  EXPECT_NE(road, bridge);
}

TEST(VoxelMap, FindsWhatWasAllocatedUntilItIsErased) {
  // Against a set, over random insertions and removals that span many blocks and negative indices.
  VoxelMap map({});
  std::mt19937 random(1);
  std::uniform_int_distribution<int> coordinate(-20, 20);
  std::set<std::array<int, 3>> expected;
  for (int i = 0; i < 20000; ++i) {
    const std::array<int, 3> key{coordinate(random), coordinate(random), coordinate(random) / 8};
    const VoxelIndex index(key[0], key[1], key[2]);
    if (i % 3 == 0) {
      const VoxelId id = map.find(index);
      EXPECT_EQ(id != kNoVoxel, expected.contains(key));
      if (id != kNoVoxel) map.erase(id);
      expected.erase(key);
    } else {
      const VoxelId id = map.find_or_allocate(index);
      EXPECT_EQ(map[id].index, index);
      EXPECT_TRUE(map[id].alive);
      expected.insert(key);
    }
    ASSERT_EQ(map.living(), expected.size());
  }
}

TEST(VoxelMap, ReusesSlotsAndBlocks) {
  VoxelMap map({});
  for (int drive = 0; drive < 1000; ++drive) {
    const VoxelId id = map.find_or_allocate({drive * 100, 0, 0});
    EXPECT_EQ(map[id].detections[0], 0U);
    map[id].detections[0] = 7;
    map.erase(id);
  }
  EXPECT_EQ(map.slots(), 1U);
  EXPECT_EQ(map.blocks(), 0U);
}

TEST(Voxel, TheMostDetectedTypeIsTheLikelyOne) {
  Voxel voxel;
  voxel.detections = {3, 5, 4};
  EXPECT_EQ(voxel.likely_type(), MarkingType::roadedge);
  voxel.detections = {5, 5, 5};
  EXPECT_EQ(voxel.likely_type(), MarkingType::laneline);
}

}  // namespace
}  // namespace laneloom::voxels
