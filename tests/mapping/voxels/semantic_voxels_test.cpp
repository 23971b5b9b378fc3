#include "mapping/voxels/semantic_voxels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mapping/shapes.hpp"

namespace laneloom::voxels {
namespace {

class SemanticVoxels : public ::testing::Test {
 protected:
  TouchedVoxels see(const std::vector<markings::ObservedMarking>& markings,
                    const Eigen::Isometry3d& T_map_body = test::at(0)) {
    return update_voxels(markings, geometry::MapBox({}, T_map_body), config_, map_, co_observation_);
  }
  VoxelId at(double x, double y) const { return map_.find(map_.index_of({x, y, 0.1})); }

  VoxelMapConfig config_;
  VoxelMap map_{config_};
  CoObservation co_observation_;
  Instances instances_;
};

markings::ObservedMarking line(MarkingType type, const Point& from, const Point& to) {
  return {type, MarkingStyle::solid, 0.9, {from, to}};
}

TEST_F(SemanticVoxels, TouchesEveryVoxelAlongALineOnce) {
  const auto touched = see({line(MarkingType::laneline, {0.05, 0.1, 0.1}, {9.95, 0.1, 0.1})});
  EXPECT_EQ(touched.all.size(), 50U);
  for (int i = 0; i < 50; ++i) {
    const VoxelId id = at(0.1 + 0.2 * i, 0.1);
    ASSERT_NE(id, kNoVoxel) << i;
    EXPECT_EQ(map_[id].count(MarkingType::laneline), 1U);
    EXPECT_EQ(map_[id].styles[index(MarkingStyle::solid)], 1U);
  }
}

TEST_F(SemanticVoxels, ADiagonalLeavesNoGap) {
  const auto touched = see({line(MarkingType::laneline, {0.05, 0.05, 0.1}, {7.05, 7.05, 0.1})});
  // Neighbours along the line share a face, an edge or a corner.
  for (const VoxelId id : touched.all) {
    const auto near = [&](VoxelId other) {
      return other != id && (map_[id].index - map_[other].index).cwiseAbs().maxCoeff() == 1;
    };
    EXPECT_TRUE(std::ranges::any_of(touched.all, near));
  }
  EXPECT_GE(touched.all.size(), 35U);
}

TEST_F(SemanticVoxels, CountsEachTypeApart) {
  see({line(MarkingType::laneline, {1, 0.1, 0.1}, {2, 0.1, 0.1}),
       line(MarkingType::roadedge, {1, 0.1, 0.1}, {2, 0.1, 0.1})});
  see({line(MarkingType::roadedge, {1, 0.1, 0.1}, {2, 0.1, 0.1})});
  const Voxel& voxel = map_[at(1.5, 0.1)];
  EXPECT_EQ(voxel.count(MarkingType::laneline), 1U);
  EXPECT_EQ(voxel.count(MarkingType::roadedge), 2U);
  EXPECT_EQ(voxel.likely_type(), MarkingType::roadedge);
}

TEST_F(SemanticVoxels, AllocatesOnlyWithinTheRangeAndItsMargin) {
  see({line(MarkingType::laneline, {-100, 0.1, 0.1}, {100, 0.1, 0.1})});
  EXPECT_NE(at(54.9, 0.1), kNoVoxel);  // 30 m and a margin of 25 m
  EXPECT_EQ(at(55.3, 0.1), kNoVoxel);
  EXPECT_NE(at(-29.9, 0.1), kNoVoxel);
  EXPECT_EQ(at(-30.3, 0.1), kNoVoxel);
}

TEST_F(SemanticVoxels, ReliableIsWhatWasDetectedMoreOftenThanAlphaN) {
  const std::vector<markings::ObservedMarking> markings{
      line(MarkingType::laneline, {0.05, 0.1, 0.1}, {1.95, 0.1, 0.1})};
  TouchedVoxels touched;
  for (int i = 0; i < 10; ++i) touched = see(markings);
  EXPECT_TRUE(reliable_voxels(touched.all, map_, instances_, 10).empty());
  touched = see(markings);
  EXPECT_EQ(reliable_voxels(touched.all, map_, instances_, 10).size(), 10U);
}

TEST_F(SemanticVoxels, WhatIsInAnInstanceOfItsTypeIsNotNew) {
  const auto touched = see({line(MarkingType::laneline, {0.05, 0.1, 0.1}, {1.95, 0.1, 0.1})});
  Instance& laneline = instances_.create(1, MarkingType::laneline, 0);
  instances_.add(laneline, touched.all[0], map_);
  Instance& roadedge = instances_.create(2, MarkingType::roadedge, 0);
  instances_.add(roadedge, touched.all[1], map_);
  const auto reliable = reliable_voxels(touched.all, map_, instances_, 0);
  EXPECT_EQ(reliable.size(), 9U);
  EXPECT_EQ(std::ranges::count(reliable, touched.all[0]), 0);
  EXPECT_EQ(std::ranges::count(reliable, touched.all[1]), 1);  // its likely type has changed
}

}  // namespace
}  // namespace laneloom::voxels
