#include "evaluation/steadiness.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace laneloom::evaluation {
namespace {

Lane lane(ElementId id, const Polyline& centerline, Lane::Direction direction = Lane::Direction::unknown) {
  return {.id = id, .centerline = centerline, .width_m = 3.5, .direction = direction};
}

/// A lane along x, with a point about every metre.
Lane straight(ElementId id, double y_m, double from_m = -50.0, double to_m = 150.0) {
  return lane(id, MeasuredPolyline({{from_m, y_m, 0}, {to_m, y_m, 0}}).resample(1.0));
}

/// Drives along x, with a map every metre and every 0.1 s. The first map counts.
class Drive {
 public:
  Drive() { meter_.add({.stamp_ns = 0}); }
  explicit Drive(const simulation::Road& truth) : meter_(truth) { meter_.add({.stamp_ns = 0}); }

  void see(std::vector<Lane> lanes, std::vector<Linkage> linkages = {}) {
    LocalMap map{.stamp_ns = stamp_ns_, .lanes = std::move(lanes), .linkages = std::move(linkages)};
    map.T_map_body.translation().x() = x_m_;
    meter_.add(map);
    stamp_ns_ += 100'000'000;
    x_m_ += 1.0;
  }
  /// All but one map further on, which is within the last 4 m.
  Steadiness end() {
    x_m_ += 10.0;
    see({});
    return meter_.steadiness();
  }

 private:
  SteadinessMeter meter_;
  std::int64_t stamp_ns_ = 2'000'000'000;
  double x_m_ = 0.0;
};

Steadiness drive(const std::vector<std::vector<Lane>>& maps, const std::vector<Linkage>& linkages = {}) {
  Drive drive;
  for (const std::vector<Lane>& lanes : maps) drive.see(lanes, linkages);
  return drive.end();
}

TEST(Steadiness, TheBeginAndTheEndOfADriveDoNotCount) {
  SteadinessMeter meter;
  for (std::int64_t i = 0; i < 60; ++i) {
    LocalMap map{.stamp_ns = i * 100'000'000, .lanes = {straight(1, 0)}};
    map.T_map_body.translation().x() = static_cast<double>(i);
    meter.add(map);
  }
  const Steadiness steadiness = meter.steadiness();
  EXPECT_EQ(steadiness.maps, 36u) << "from 2 s on, and more than 4 m before the end";
  EXPECT_NEAR(steadiness.duration_s, 3.5, 1e-9);
  EXPECT_NEAR(steadiness.driven_m, 35.0, 1e-9);
  EXPECT_EQ(steadiness.lanes, 36u);
}

TEST(Steadiness, AMapThatIsNotLaterIsPassedOver) {
  SteadinessMeter meter;
  for (const std::int64_t stamp_ns : {0, 0, 0}) meter.add({.stamp_ns = stamp_ns});
  EXPECT_EQ(meter.steadiness().maps, 0u);
  LocalMap map{.stamp_ns = 2'000'000'000};
  meter.add(map);
  meter.add(map);
  map.stamp_ns += 1;
  map.T_map_body.translation().x() = 5.0;
  meter.add(map);
  EXPECT_EQ(meter.steadiness().maps, 1u);
}

TEST(Steadiness, AnUnchangedMapIsSteady) {
  const std::vector<Lane> lanes{straight(1, 0), straight(2, 3.5)};
  const Steadiness steady = drive({lanes, lanes, lanes});
  EXPECT_EQ(steady.lanes, 6u);
  EXPECT_EQ(steady.blinks + steady.turned + steady.doubted + steady.own_changes, 0u);
  EXPECT_EQ(steady.own_lanes, 3u);
  EXPECT_EQ(steady.jump_m[0].count(), 2u);
  EXPECT_NEAR(steady.jump_m[2].quantile(1.0), 0.0, 1e-9);
}

TEST(Steadiness, ALaneThatGoesAndComesBlinksTwice) {
  const Lane own = straight(1, 0), other = straight(2, 3.5);
  const Steadiness steadiness = drive({{own, other}, {own}, {own, other}, {own, other}});
  EXPECT_EQ(steadiness.blinks, 2u);
  EXPECT_EQ(steadiness.ended, 1u);
  EXPECT_NEAR(steadiness.per_second(steadiness.blinks), 2.0 / 0.3, 1e-9);
}

TEST(Steadiness, OnlyTheInnerRangeBlinks) {
  const Lane own = straight(1, 0);
  const auto blinks = [&](const Lane& other) { return drive({{own}, {own, other}, {own}}).blinks; };
  EXPECT_EQ(blinks(straight(2, 3.5, 5, 9)), 2u);
  EXPECT_EQ(blinks(straight(2, 3.5, 5, 8)), 0u) << "3 m are too short";
  EXPECT_EQ(blinks(straight(2, 12.5, 5, 9)), 0u);
  EXPECT_EQ(blinks(straight(2, 3.5, 30, 34)), 0u);
  EXPECT_EQ(blinks(straight(2, 3.5, -9, -5)), 0u);
}

TEST(Steadiness, ALifeOfHalfASecondIsNotShort) {
  const Lane own = straight(1, 0), other = straight(2, 3.5);
  const auto after = [&](std::size_t maps) {
    std::vector<std::vector<Lane>> seen(maps, {own, other});
    seen.push_back({own});
    return drive(seen);
  };
  EXPECT_EQ(after(4).short_lives, 1u);
  EXPECT_EQ(after(5).ended, 1u);
  EXPECT_EQ(after(5).short_lives, 0u);
}

TEST(Steadiness, ACenterlineOfOneIdThatLeadsTheOtherWayIsTurned) {
  const Lane there = straight(1, 0, -50, 150), back = straight(1, 0, 150, -50);
  const Steadiness steadiness = drive({{there}, {back}, {back}, {there}});
  EXPECT_EQ(steadiness.turned, 2u);
  EXPECT_EQ(steadiness.doubted, 0u);
  EXPECT_EQ(steadiness.blinks, 0u);
}

TEST(Steadiness, ADirectionThatChangesOrIsForgottenIsDoubted) {
  const auto known = [](Lane::Direction direction) {
    return std::vector<Lane>{lane(1, {{-50, 0, 0}, {150, 0, 0}}, direction)};
  };
  const auto unknown = known(Lane::Direction::unknown), along = known(Lane::Direction::along_centerline),
             against = known(Lane::Direction::against_centerline);
  EXPECT_EQ(drive({unknown, along, along, against, unknown}).doubted, 3u);
}

TEST(Steadiness, TheOwnLaneIsUnderTheVehicle) {
  const Lane across = lane(3, {{0, -20, 0}, {1, 20, 0}});
  const Steadiness steadiness = drive({{straight(1, 1.7)}, {straight(1, 1.8)}, {across}, {}});
  EXPECT_EQ(steadiness.own_wanted, 4u);
  EXPECT_EQ(steadiness.own_lanes, 1u);
  EXPECT_EQ(steadiness.reach_m.count(), 1u);
}

TEST(Steadiness, ThePathOfALinkageIsAnOwnLaneToo) {
  const Linkage linkage{.from = 1, .to = 2, .path = {{-5, 0, 0}, {5, 0, 0}}};
  const Steadiness steadiness = drive({{straight(1, 0, -50, -5), straight(2, 0.5, 6, 20)}}, {linkage});
  EXPECT_EQ(steadiness.own_lanes, 1u);
  EXPECT_NEAR(steadiness.step_m.quantile(1.0), 0.5, 1e-9) << "from the path to the lane behind it";
  EXPECT_NEAR(steadiness.reach_m.quantile(0.5), 5.0 + std::hypot(1.0, 0.5) + 14.0, 1e-9);
}

TEST(Steadiness, AnotherIdUnderTheVehicleIsAChange) {
  const Lane before = straight(1, 0), now = straight(2, 0.1);
  EXPECT_EQ(drive({{before}, {now}, {now}, {before}}).own_changes, 2u);
  EXPECT_EQ(drive({{before}, {}, {now}}).own_changes, 1u) << "across a map without own lane";
  EXPECT_NEAR(drive({{before}, {now}, {now}}).own_changes_per_km(), 500.0, 1e-9);
}

TEST(Steadiness, ALinkageOrALaneChangeExplainsAnotherId) {
  const Lane before = straight(1, 0), now = straight(2, 0.1), beside = straight(1, 3.5);
  EXPECT_EQ(drive({{before}, {now}}, {{.from = 1, .to = 2}}).own_changes, 0u);
  EXPECT_EQ(drive({{before}, {now}}, {{.from = 2, .to = 1}}).own_changes, 0u);
  EXPECT_EQ(drive({{before}, {now}}, {{.from = 2, .to = 3}}).own_changes, 1u);
  EXPECT_EQ(drive({{before}, {beside, now}}).own_changes, 0u);
}

TEST(Steadiness, TheReachGoesOverLinkages) {
  EXPECT_NEAR(drive({{straight(1, 0, -50, 12)}}).reach_m.quantile(0.5), 12.0, 1e-9);
  const std::vector<Lane> lanes{straight(1, 0, -50, 12), straight(2, 0, 12, 20)};
  EXPECT_NEAR(drive({lanes}, {{.from = 1, .to = 2}}).reach_m.quantile(0.5), 20.0, 1e-9);
  EXPECT_EQ(drive({{straight(1, 0)}}).reach_m.quantile(0.5), 30.0);
}

TEST(Steadiness, AGapAndItsPartAcrossTheWayAreAtJoints) {
  const std::vector<Lane> lanes{straight(1, 0, -50, 10), straight(2, 0.3, 10.4, 50)};
  const Steadiness steadiness = drive({lanes}, {{.from = 1, .to = 2}});
  ASSERT_EQ(steadiness.gap_m.count(), 1u);
  EXPECT_NEAR(steadiness.gap_m.quantile(1.0), 0.5, 1e-9);
  EXPECT_NEAR(steadiness.step_m.quantile(1.0), 0.3, 1e-9);
}

TEST(Steadiness, AWayThatMovesAsideJumps) {
  const Steadiness moved = drive({{straight(1, 0.1)}, {straight(1, -0.1)}});
  for (const Distribution& jump_m : moved.jump_m) EXPECT_NEAR(jump_m.quantile(1.0), 0.2, 1e-9);
  // The second map is seen from x = 1.
  const Steadiness bent = drive({{straight(1, 0)}, {lane(1, {{-49, -0.5, 0}, {101, 1.0, 0}})}});
  EXPECT_NEAR(bent.jump_m[0].quantile(1.0), 0.0, 1e-3);
  EXPECT_NEAR(bent.jump_m[1].quantile(1.0), 0.1, 1e-3);
  EXPECT_NEAR(bent.jump_m[2].quantile(1.0), 0.2, 1e-3);
}

TEST(Steadiness, AWayThatEndsDoesNotJumpBeyond) {
  const Steadiness steadiness = drive({{straight(1, 0)}, {straight(1, 0.2, -50, 15)}});
  EXPECT_EQ(steadiness.jump_m[1].count(), 1u);
  EXPECT_EQ(steadiness.jump_m[2].count(), 0u);
}

TEST(Steadiness, WithTruthTheWayIsRightBesideMostOfTheNext10M) {
  const simulation::Road truth{.lanes = {{.id = 9, .centerline = {{-50, 0, 0}, {150, 0, 0}}}}};
  const auto right = [&](const Lane& lane) {
    Drive drive(truth);
    drive.see({lane});
    const Steadiness steadiness = drive.end();
    EXPECT_EQ(steadiness.true_ways, 1u);
    return steadiness.right_ways;
  };
  EXPECT_EQ(right(straight(1, 0.4)), 1u);
  EXPECT_EQ(right(straight(1, 0.6)), 0u);
  EXPECT_EQ(right(straight(1, 0, -50, 8)), 1u);
  EXPECT_EQ(right(straight(1, 0, -50, 6)), 0u);
  EXPECT_EQ(right(straight(1, 5.0)), 0u) << "no own lane";
}

TEST(Steadiness, WhereTheTruthHasNoLaneNoneIsWanted) {
  Drive drive(simulation::Road{.lanes = {{.id = 9, .centerline = {{-50, 9, 0}, {150, 9, 0}}}}});
  drive.see({straight(1, 0)});
  const Steadiness steadiness = drive.end();
  EXPECT_EQ(steadiness.own_wanted, 0u);
  EXPECT_EQ(steadiness.own_lanes, 0u);
  EXPECT_EQ(steadiness.true_ways, 0u);
}

TEST(Steadiness, DrivesAddUp) {
  const Lane own = straight(1, 0), other = straight(2, 3.5);
  Steadiness sum = drive({{own, other}, {own}});
  sum += sum;
  EXPECT_EQ(sum.maps, 4u);
  EXPECT_EQ(sum.blinks, 2u);
  EXPECT_NEAR(sum.duration_s, 0.2, 1e-9);
  EXPECT_EQ(sum.jump_m[1].count(), 2u);
}

}  // namespace
}  // namespace laneloom::evaluation
