#include "mapping/voxels/vectorise.hpp"

#include <gtest/gtest.h>

#include "mapping/shapes.hpp"

namespace laneloom::voxels {
namespace {

using test::straight;

class Vectorise : public ::testing::Test {
 protected:
  Instance& instance_along(const Polyline& line, MarkingType type = MarkingType::laneline) {
    Instance& instance = instances_.create(ids_.next(), type, 0);
    for (const Point& p : MeasuredPolyline(line).resample(0.2)) {
      const VoxelId id = map_.find_or_allocate(map_.index_of(p));
      map_[id].detections[index(type)] = 20;
      if (map_[id].instance == kNoElement) instances_.add(instance, id, map_);
    }
    return instance;
  }
  void update(const Eigen::Vector2d& forward = {1, 0}) {
    update_polylines({}, {}, map_, forward, instances_);
  }

  VoxelMap map_{VoxelMapConfig{}};
  Instances instances_;
  markings::IdSource ids_;
};

TEST_F(Vectorise, ANewLineRunsForwardAndKeepsItsDirection) {
  const Instance& instance = instance_along(straight({0, 0.1, 0}, {20, 0.1, 0}));
  update({-1, 0});
  EXPECT_GT(instance.points.front().x(), instance.points.back().x());
  instances_.all()[0].dirty = true;
  update({1, 0});
  EXPECT_GT(instance.points.front().x(), instance.points.back().x());
}

TEST_F(Vectorise, OnlyWhatChangedIsEstimatedAgain) {
  Instance& instance = instance_along(straight({0, 0.1, 0}, {20, 0.1, 0}));
  update();
  EXPECT_FALSE(instance.dirty);
  instance.points = {{1, 2, 3}, {4, 5, 6}};
  update();
  EXPECT_EQ(instance.points[0], Point(1, 2, 3));
}

TEST_F(Vectorise, SmallInstancesAreNotVectorised) {
  instance_along(straight({0, 0.1, 0}, {2.5, 0.1, 0}));  // 2.5 m of a laneline: too short
  instance_along(straight({10, -1, 0}, {10, 1.5, 0}), MarkingType::stopline);  // of a stopline: enough
  update();
  EXPECT_TRUE(instances_.all()[0].points.empty());
  EXPECT_EQ(instances_.all()[1].points.size(), 2U);
}

TEST_F(Vectorise, StylesFollowTheVotesAlongTheLine) {
  const Instance& instance = instance_along(straight({0, 0.1, 0}, {20, 0.1, 0}));
  for (const VoxelId id : instance.voxels) {
    const double x = map_.center(map_[id]).x();
    const MarkingStyle style = x < 8 ? MarkingStyle::solid : MarkingStyle::dashed;
    if (x < 16) map_[id].styles[index(style)] = 7;
    map_[id].styles[index(MarkingStyle::unknown)] = 50;  // says nothing against either
  }
  update();
  ASSERT_EQ(instance.styles.size(), 3U);
  EXPECT_EQ(instance.styles[0].style, MarkingStyle::solid);
  EXPECT_NEAR(instance.styles[0].range.to_m, 8.0, 1e-9);
  EXPECT_EQ(instance.styles[1].style, MarkingStyle::dashed);
  EXPECT_EQ(instance.styles[2].style, MarkingStyle::unknown);
  EXPECT_NEAR(instance.styles[2].range.to_m, length(instance.points), 1e-9);
}

TEST_F(Vectorise, AContestedStyleIsUnknown) {
  const Instance& instance = instance_along(straight({0, 0.1, 0}, {20, 0.1, 0}));
  for (const VoxelId id : instance.voxels) map_[id].styles = {0, 5, 5};
  update();
  ASSERT_EQ(instance.styles.size(), 1U);
  EXPECT_EQ(instance.styles[0].style, MarkingStyle::unknown);
}

TEST_F(Vectorise, MarkingsAreCutAtTheRange) {
  instance_along(straight({-12, 0.1, 0}, {38, 0.1, 0}));
  update();
  const auto markings = markings_in_range(geometry::MapBox({}, test::at(0)), 3.0, instances_, ids_);
  ASSERT_EQ(markings.size(), 1U);
  EXPECT_EQ(markings[0].id, 1U);
  EXPECT_NEAR(markings[0].points.front().x(), -5.0, 1e-6);
  EXPECT_NEAR(markings[0].points.back().x(), 30.0, 1e-6);
  EXPECT_NEAR(markings[0].styles.back().range.to_m, 35.0, 0.01);
}

TEST_F(Vectorise, StretchesOfOneLineHaveLastingIdsOfTheirOwn) {
  Instance& instance = instance_along(straight({0, 0, 0}, {1, 0, 0}));
  instance.points = {{0, 0, 0}, {0, 20, 0}, {10, 20, 0}, {10, 0, 0}};
  instance.styles = {{{0, 50}, MarkingStyle::solid}};
  const geometry::MapBox range({}, test::at(0));
  const auto first = markings_in_range(range, 3.0, instances_, ids_);
  const auto second = markings_in_range(range, 3.0, instances_, ids_);
  ASSERT_EQ(first.size(), 2U);
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(first[0].id, 1U);
  EXPECT_EQ(first[1].id, 2U);
  EXPECT_EQ(second[1].id, 2U);
}

}  // namespace
}  // namespace laneloom::voxels
