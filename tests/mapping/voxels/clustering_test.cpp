#include "mapping/voxels/clustering.hpp"

#include <gtest/gtest.h>

namespace laneloom::voxels {
namespace {

class Clustering : public ::testing::Test {
 protected:
  /// One detection in a frame of its own.
  void see(const std::vector<VoxelId>& voxels, MarkingType type = MarkingType::laneline) {
    co_observation_.begin_frame(1000, map_);
    co_observation_.record(type, MarkingStyle::unknown, voxels, map_);
  }
  void cluster_now(const std::vector<VoxelId>& reliable) {
    cluster(reliable, config_, 5, semantic_map_, ids_);
  }
  std::vector<VoxelId> row(int y, int count) {
    std::vector<VoxelId> voxels;
    for (int x = 0; x < count; ++x) voxels.push_back(map_.find_or_allocate({x, y, 0}));
    return voxels;
  }

  ClusteringConfig config_;
  SemanticMap semantic_map_{VoxelMap(VoxelMapConfig{})};
  VoxelMap& map_ = semantic_map_.voxels;
  CoObservation& co_observation_ = semantic_map_.co_observation;
  Instances& instances_ = semantic_map_.instances;
  markings::IdSource ids_;
};

TEST_F(Clustering, VoxelsOfOneDetectionBecomeOneInstance) {
  const auto line = row(0, 10);
  see(line);
  cluster_now(line);
  ASSERT_EQ(instances_.all().size(), 1U);
  EXPECT_EQ(instances_.all()[0].voxels.size(), 10U);
  EXPECT_EQ(instances_.all()[0].first_seen_ns, 5);
}

TEST_F(Clustering, ParallelLinesStayApart) {
  const auto a = row(0, 10), b = row(17, 10);
  see(a);
  see(b);
  auto both = a;
  both.insert(both.end(), b.begin(), b.end());
  cluster_now(both);
  EXPECT_EQ(instances_.all().size(), 2U);
}

/// An instance of 20 voxels, and a voxel that was seen with the first `together` of them.
class BetaN : public Clustering, public ::testing::WithParamInterface<int> {};

TEST_P(BetaN, MoreVoxelsThanBetaNMustBeLikely) {
  const int together = GetParam();
  const auto line = row(0, 20);
  for (int i = 0; i < 5; ++i) see(line);
  cluster_now(line);
  auto seen = std::vector(line.begin(), line.begin() + together);
  seen.push_back(map_.find_or_allocate({0, 1, 0}));
  for (int i = 0; i < 5; ++i) see(seen);
  cluster_now({seen.back()});
  EXPECT_EQ(instances_.all().size(), together > config_.min_voxels ? 1U : 2U);
}

INSTANTIATE_TEST_SUITE_P(Together, BetaN, ::testing::Values(1, 3, 4, 10));

TEST_F(Clustering, TheNearestCoObservedInstanceIsTakenOnDemand) {
  const auto near = row(0, 20), far = row(9, 20);
  for (int i = 0; i < 5; ++i) {
    see(near);
    see(far);
  }
  auto both = near;
  both.insert(both.end(), far.begin(), far.end());
  cluster_now(both);
  ASSERT_EQ(instances_.all().size(), 2U);
  // Seen with one voxel of the near line, and with all of the far one.
  const VoxelId candidate = map_.find_or_allocate({0, 1, 0});
  auto seen = far;
  seen.push_back(near.front());
  seen.push_back(candidate);
  for (int i = 0; i < 5; ++i) see(seen);
  cluster_now({candidate});
  EXPECT_EQ(map_[candidate].instance, map_[far.back()].instance);
  config_.nearest_instance = true;
  cluster_now({candidate});
  EXPECT_EQ(map_[candidate].instance, map_[near.back()].instance);
}

TEST_F(Clustering, ARatioAboveBetaRIsEnoughInASmallInstance) {
  const auto line = row(0, 2);
  see(line);
  cluster_now(line);  // the second voxel joins by the ratio 1 / 1
  EXPECT_EQ(instances_.all().size(), 1U);
}

TEST_F(Clustering, ProbabilityIsOverTheSmallerCountAndAboveBetaP) {
  const auto line = row(0, 10);
  for (int i = 0; i < 10; ++i) see(line);
  cluster_now(line);
  // Seen 5 times, 3 of them with the line: 3 / 5 is not above 0.6. A sixth time with it: 4 / 6 is.
  const VoxelId candidate = map_.find_or_allocate({0, 1, 0});
  auto with_line = line;
  with_line.push_back(candidate);
  for (int i = 0; i < 3; ++i) see(with_line);
  for (int i = 0; i < 2; ++i) see({candidate});
  cluster_now({candidate});
  ASSERT_EQ(instances_.all().size(), 2U);
  instances_.remove(candidate, map_);
  instances_.erase_empty();
  see(with_line);
  cluster_now({candidate});
  EXPECT_EQ(instances_.all().size(), 1U);
}

TEST_F(Clustering, TheBestMatchWins) {
  const auto a = row(0, 10), b = row(5, 10);
  see(a);
  see(b);
  cluster_now(a);
  cluster_now(b);
  const VoxelId candidate = map_.find_or_allocate({0, 2, 0});
  see({a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], b[4], candidate});
  cluster_now({candidate});
  ASSERT_EQ(instances_.all().size(), 2U);
  EXPECT_EQ(map_[candidate].instance, map_[b[0]].instance);
}

TEST_F(Clustering, AVoxelOfAnotherTypeDoesNotJoin) {
  const auto line = row(0, 10);
  see(line);
  cluster_now(line);
  auto edge = line;
  edge.push_back(map_.find_or_allocate({0, 1, 0}));
  see(edge, MarkingType::roadedge);
  cluster_now({edge.back()});
  ASSERT_EQ(instances_.all().size(), 2U);
  EXPECT_EQ(instances_.all()[1].type, MarkingType::roadedge);
}

TEST_F(Clustering, AVoxelWhoseTypeChangedMovesAndAnEmptyInstanceGoes) {
  const auto line = row(0, 5);
  see(line);
  cluster_now(line);
  for (int i = 0; i < 2; ++i) see(line, MarkingType::roadedge);
  cluster_now(line);
  ASSERT_EQ(instances_.all().size(), 1U);
  EXPECT_EQ(instances_.all()[0].type, MarkingType::roadedge);
  EXPECT_EQ(instances_.all()[0].id, 2U);  // ids are never used again
  EXPECT_EQ(instances_.all()[0].voxels.size(), 5U);
}

TEST_F(Clustering, CountsEachDetectionOncePerInstance) {
  const auto a = row(0, 5), b = row(9, 5);
  see(a);
  see(b);
  cluster_now(a);
  cluster_now(b);
  auto across = a;
  across.push_back(b[0]);
  count_observations({a, across}, map_, instances_);
  EXPECT_EQ(instances_[1].observations, 2U);
  EXPECT_EQ(instances_[2].observations, 1U);
}

}  // namespace
}  // namespace laneloom::voxels
