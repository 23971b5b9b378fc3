#include "mapping/topology/driven_paths.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "mapping/shapes.hpp"

namespace laneloom::topology {
namespace {

using test::straight;

/// Points a metre apart.
trails::Trail trail(std::uint64_t object, const Polyline& line) {
  return {.session = 1, .object = object, .points = MeasuredPolyline(line).resample(1.0)};
}

/// A vehicle at the origin that looks along x, on a road whose lanes and linkages a test sets.
class DrivenPaths : public ::testing::Test {
 protected:
  std::vector<DrivenPath> paths() const {
    return driven_paths(trails_, driven_stretches(trails_, road_.lanes), road_, test::scene(1).box);
  }

  RoadGraph road_;
  std::vector<trails::Trail> trails_;
};

TEST_F(DrivenPaths, LieWhereOneVehicleDroveAndNoLaneIs) {
  trails_ = {trail(1, straight({0, 5, 0}, {25, 5, 0}))};
  const std::vector<DrivenPath> found = paths();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].points.front().x(), 0.0, 0.1) << "as it was driven";
  EXPECT_NEAR(found[0].points.back().x(), 25.0, 0.1);
  for (const Point& point : found[0].points) EXPECT_NEAR(point.y(), 5.0, 0.01);
  EXPECT_GE(found[0].lateral_stddev_m, 0.6);
  EXPECT_GT(found[0].probability, 0.5);
  EXPECT_LT(found[0].probability, 1.0);
}

TEST_F(DrivenPaths, AreSmoothWhereATrackerErrs) {
  trails::Trail noisy = trail(1, straight({0, 5, 0}, {25, 5, 0}));
  for (std::size_t i = 0; i < noisy.points.size(); ++i) noisy.points[i].y() += i % 2 == 0 ? 0.4 : -0.4;
  trails_ = {noisy};
  const std::vector<DrivenPath> found = paths();
  ASSERT_EQ(found.size(), 1U);
  for (const Point& point : found[0].points) EXPECT_NEAR(point.y(), 5.0, 0.15);
}

TEST_F(DrivenPaths, EndWhereALaneIsAndGoOnBehindIt) {
  road_.lanes = {test::lane(1, {-20, 5, 0}, {5, 5, 0}), test::lane(2, {20, 5, 0}, {60, 5, 0})};
  trails_ = {trail(1, straight({-4, 5.5, 0}, {29, 5.5, 0}))};
  const std::vector<DrivenPath> found = paths();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].points.front().x(), 6.0, 1.1);
  EXPECT_NEAR(found[0].points.back().x(), 19.0, 1.1);
}

TEST_F(DrivenPaths, AreNotToldBesideALaneWhateverItsDirection) {
  trails_ = {trail(1, straight({0, 5, 0}, {25, 5, 0}))};
  road_.lanes = {test::lane(1, {60, 7.4, 0}, {-20, 7.4, 0})};
  EXPECT_TRUE(paths().empty()) << "a tracker errs by as much";
  road_.lanes = {test::lane(1, {60, 8, 0}, {-20, 8, 0})};
  EXPECT_EQ(paths().size(), 1U) << "beyond the lane";
  road_.lanes = {test::lane(1, {60, 5, 6}, {-20, 5, 6})};
  EXPECT_EQ(paths().size(), 1U) << "below a bridge";
}

TEST_F(DrivenPaths, AcrossALaneAreTold) {
  road_.lanes = {test::lane(1, {12, -20, 0}, {12, 20, 0})};
  trails_ = {trail(1, straight({0, 5, 0}, {25, 5, 0}))};
  EXPECT_EQ(paths().size(), 1U);
}

TEST_F(DrivenPaths, AlongAPassageAreToldOnlyAgainstIt) {
  road_.lanes = {test::lane(1, {-50, 0, 0}, {-40, 0, 0}), test::lane(2, {60, 0, 0}, {70, 0, 0})};
  road_.linkages = {{.from = 1, .to = 2, .path = straight({-40, 5, 0}, {60, 5, 0})}};
  trails_ = {trail(1, straight({0, 5, 0}, {25, 5, 0}))};
  EXPECT_TRUE(paths().empty());
  trails_ = {trail(1, straight({25, 5, 0}, {0, 5, 0}))};
  EXPECT_EQ(paths().size(), 1U);
}

TEST_F(DrivenPaths, OfSeveralVehiclesAreOneAndItStaysInPlace) {
  trails_ = {trail(1, straight({0, 5, 0}, {25, 5, 0}))};
  const Polyline alone = paths().at(0).points;
  trails_.push_back(trail(2, straight({0, 6, 0}, {25, 6, 0})));
  ASSERT_EQ(paths().size(), 1U);
  EXPECT_EQ(paths()[0].points, alone);
  trails_.push_back(trail(3, straight({25, 6, 0}, {0, 6, 0})));
  EXPECT_EQ(paths().size(), 2U) << "the other way";
}

TEST_F(DrivenPaths, AreTheLessSureTheMoreOftenATrackerLosesItsObjects) {
  trails_ = {trail(1, straight({0, 5, 0}, {30, 5, 0}))};
  const double sound = paths().at(0).probability;
  trails_.push_back(trail(2, straight({0, -40, 0}, {10, -40, 0})));
  EXPECT_NEAR(paths().at(0).probability, 0.75 / 0.8 * sound, 1e-9) << "a quarter of all metres";
  trails_.push_back(trail(3, straight({0, -44, 0}, {19, -44, 0})));
  EXPECT_TRUE(paths().empty()) << "the long trail, too, may be patched together";
  trails_.push_back(trail(4, straight({0, -48, 0}, {60, -48, 0})));
  EXPECT_FALSE(paths().empty()) << "others are followed well";
}

TEST_F(DrivenPaths, AreNotOfGhostsNorFarAway) {
  trails_ = {trail(1, straight({0, 5, 0}, {15, 5, 0}))};
  EXPECT_TRUE(paths().empty()) << "too short a trail";
  trails_ = {trail(1, straight({200, 5, 0}, {240, 5, 0}))};
  EXPECT_TRUE(paths().empty()) << "outside of the box";
  trails_ = {{.session = 1, .object = 1, .points = {{0, 5, 0}, {12, 5, 0}, {24, 5, 0}}}};
  EXPECT_TRUE(paths().empty()) << "a trail with holes";
  trails_.clear();
  EXPECT_TRUE(paths().empty());
}

}  // namespace
}  // namespace laneloom::topology
