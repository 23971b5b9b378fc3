#include "mapping/lines/line_fusion.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "mapping/lines/line_evidence.hpp"
#include "mapping/lines/line_growth.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::straight;

/// Sees detections from the map's origin, frame by frame.
class LineFusion : public ::testing::Test {
 protected:
  LineFusion() { networks_.number("", 1, {.fusion = config_}); }

  void see(const std::vector<Polyline>& polylines, MarkingType type = MarkingType::laneline) {
    std::vector<markings::ObservedMarking> markings;
    for (const Polyline& points : polylines) markings.push_back({type, MarkingStyle::solid, 0.8, points});
    see_markings(std::move(markings));
  }

  void see_markings(std::vector<markings::ObservedMarking> markings) {
    for (markings::ObservedMarking& marking : markings) marking.belief = model_.belief(marking.confidence);
    Association association = associated(markings);
    fuse_matches(association, {}, config_, networks_, lines_);
    const View view(Eigen::Isometry3d::Identity(), frame_);
    credit_observed(view, association, config_, model_, lines_);
    discount_unobserved(view, range_, config_, model_, lines_);
    extend_lines(Viewpoint{}, range_, config_, association, lines_);
    for (Line& line : new_lines(association.detections, Viewpoint{}, range_, config_, model_)) {
      line.id = ids_.next();
      lines_.push_back(std::move(line));
    }
    std::ranges::copy(prune_lines(range_, config_, lines_, ids_), std::back_inserter(cut_off_));
  }

  Association associated(const std::vector<markings::ObservedMarking>& markings) {
    auto detections = sample_detections(markings, config_);
    weigh(NetworkModel(config_), Point::Zero(), detections);
    LineMatcher matcher(lines_, config_);
    return associate(matcher, std::move(detections));
  }

  FusionConfig config_;
  geometry::MapBox range_{RangeConfig{}, Eigen::Isometry3d::Identity()};
  DetectionFrame frame_;
  DetectionModel model_;
  std::vector<Line> lines_;
  Networks networks_;
  markings::IdSource ids_;
  std::vector<markings::Relative> cut_off_;
};

TEST_F(LineFusion, ALineIsUnknownToTheFrameThatBearsIt) {
  see({straight({5, 0, 0}, {15, 0, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(sight_of(lines_[0].stations), Sight::missed);
  see({straight({5, 0, 0}, {15, 0, 0})});
  EXPECT_EQ(sight_of(lines_[0].stations), Sight::observed);
}

TEST_F(LineFusion, ALineIsBornWithAStationAboutEveryMetre) {
  see({straight({0, 0, 0}, {20, 0, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_NEAR(static_cast<double>(lines_[0].stations.size()), 21.0, 1.0);
  EXPECT_EQ(lines_[0].stations.front().position, Point(0, 0, 0));
  EXPECT_EQ(lines_[0].stations.back().position, Point(20, 0, 0));
  EXPECT_EQ(lines_[0].type(), MarkingType::laneline);
}

TEST_F(LineFusion, ALineKnowsWhenItWasLastSeen) {
  see({straight({0, 0, 0}, {20, 0, 0})});
  frame_.stamp_ns = 9;
  see({straight({0, 0, 0}, {20, 0, 0})});
  frame_.stamp_ns = 11;
  see({});
  EXPECT_EQ(lines_[0].last_seen_ns, 9);
}

TEST_F(LineFusion, ManyObservationsAverageBelowTheirNoise) {
  see({straight({0, 0.3, 0}, {20, 0.3, 0})});
  for (int i = 0; i < 30; ++i) {
    const double y = i % 2 == 0 ? 0.3 : -0.3;
    see({straight({0, y, 0.1}, {20, y, 0.1})});
  }
  ASSERT_EQ(lines_.size(), 1U);
  for (const Station& station : lines_[0].stations) {
    const double x = station.position.x();
    if (x < 4.0 || x > 16.0) continue;  // towards its ends a detection counts less
    EXPECT_NEAR(station.position.y(), 0.0, 0.05);
    EXPECT_NEAR(station.position.z(), 0.1, 0.02);
  }
}

TEST_F(LineFusion, NearObservationsCountMore) {
  // At the vehicle one says 0.2, another one -0.2; far off likewise, but the line is known from there only.
  for (int i = 0; i < 5; ++i) see({straight({0, 0, 0}, {25, 0, 0})});
  see({straight({0, 0.4, 0}, {25, 0.4, 0})});
  const auto& stations = lines_[0].stations;
  EXPECT_GT(stations[10].position.y(), 0.04);
  EXPECT_GT(stations[20].lateral.variance_m2(), 2.0 * stations[5].lateral.variance_m2());
}

TEST_F(LineFusion, DeviationsThatAreGivenCount) {
  const auto at = [](double y, double near_m, double far_m) {
    return markings::ObservedMarking{MarkingType::laneline,
                                     MarkingStyle::solid,
                                     0.8,
                                     {{0, y, 0}, {10, y, 0}, {20, y, 0}},
                                     {near_m, near_m, far_m}};
  };
  for (int i = 0; i < 5; ++i) see_markings({at(0.0, 0.1, 0.1)});
  for (int i = 0; i < 5; ++i) see_markings({at(0.4, 0.1, 1.0)});
  EXPECT_GT(lines_[0].stations[6].position.y(), 0.15);
  EXPECT_LT(lines_[0].stations[16].position.y(), 0.05);
}

TEST_F(LineFusion, WhichWayADetectionRunsDoesNotMatter) {
  for (int i = 0; i < 3; ++i) see({straight({0, 0, 0}, {20, 0, 0})});
  const std::vector<Line> before = lines_;
  see({straight({2.3, 0.1, 0}, {14.6, 0.4, 0.2})});
  const std::vector<Line> forwards = std::exchange(lines_, before);
  see({straight({14.6, 0.4, 0.2}, {2.3, 0.1, 0})});
  ASSERT_EQ(lines_[0].stations.size(), forwards[0].stations.size());
  for (std::size_t i = 0; i < forwards[0].stations.size(); ++i) {
    EXPECT_NEAR((lines_[0].stations[i].position - forwards[0].stations[i].position).norm(), 0.0, 1e-9) << i;
    EXPECT_EQ(lines_[0].stations[i].log_odds, forwards[0].stations[i].log_odds) << i;
  }
}

/// A kerb round an island, drawn from one of its places.
Polyline ring(const Point& center, double radius_m, double begin_rad) {
  Polyline points;
  for (int i = 0; i <= 50; ++i) {
    const double angle_rad = begin_rad + 2.0 * std::numbers::pi * i / 50.0;
    points.push_back(center + radius_m * Point(std::cos(angle_rad), std::sin(angle_rad), 0.0));
  }
  return points;
}

TEST_F(LineFusion, AClosedLineIsOneAndMovesAsAWhole) {
  // The vehicle stands, so what it saw first counts for much.
  const Point seen(12, 0, 0), moved(12.3, 0, 0);
  for (int i = 0; i < 3; ++i) see({ring(seen, 8.0, 0.0)}, MarkingType::roadedge);
  for (int i = 0; i < 30; ++i) see({ring(moved, 8.0, 0.5 * i)}, MarkingType::roadedge);
  ASSERT_EQ(lines_.size(), 1U);
  for (const Station& station : lines_[0].stations) EXPECT_NEAR((station.position - moved).norm(), 8.0, 0.15);
}

TEST_F(LineFusion, OfAClosedLineOnlyWhatIsSeenGainsEvidence) {
  for (int i = 0; i < 3; ++i) see({ring({12, 0, 0}, 8.0, 0.0)}, MarkingType::roadedge);
  const auto before = lines_[0].stations;
  const Polyline all = ring({12, 0, 0}, 8.0, 5.5);  // a quarter of it, over the place where it closes
  see({Polyline(all.begin(), all.begin() + 13)}, MarkingType::roadedge);
  const auto& stations = lines_[0].stations;
  ASSERT_EQ(stations.size(), before.size());
  EXPECT_GT(stations[3].log_odds, before[3].log_odds);
  EXPECT_GT(stations[47].log_odds, before[47].log_odds);
  EXPECT_LT(stations[25].log_odds, before[25].log_odds);
}

TEST_F(LineFusion, ALineGrowsAtBothEndsInOneFrame) {
  see({straight({10, 0, 0}, {20, 0, 0})});
  see({straight({0, 0, 0}, {14, 0, 0}), straight({15, 0, 0}, {30, 0, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_NEAR(lines_[0].stations.front().position.x(), 0.0, 0.6);
  EXPECT_NEAR(lines_[0].stations.back().position.x(), 30.0, 0.6);
}

TEST_F(LineFusion, ALineGrowsNoFurtherThanTheRange) {
  see({straight({0, 0, 0}, {20, 0, 0})});
  Association association = associated(
      {{MarkingType::laneline, MarkingStyle::solid, 0.8, {{0, 0, 0}, {20, 0, 0}, {9000, 900, 0}}}});
  extend_lines(Viewpoint{}, range_, config_, association, lines_);
  EXPECT_GT(lines_[0].stations.back().position.x(), 50.0);
  for (const Station& station : lines_[0].stations) EXPECT_TRUE(range_.keeps(station.position));
}

/// Out to 20 m, round a tip, and back 3 m beside it.
Polyline hairpin() {
  Polyline points = straight({0, 0, 0}, {20, 0, 0}, 21);
  const Polyline back = straight({19.5, 1.2, 0}, {5, 3, 0}, 16);
  points.insert(points.end(), back.begin(), back.end());
  return points;
}

TEST_F(LineFusion, ALineIsExtendedRoundASharpTip) {
  for (int i = 0; i < 3; ++i) see({straight({0, 0, 0}, {19, 0, 0})}, MarkingType::roadedge);
  see({hairpin()}, MarkingType::roadedge);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_GT(lines_[0].stations.size(), 30U);
  EXPECT_NEAR(lines_[0].stations.back().position.x(), 5.0, 1.0);
  EXPECT_NEAR(lines_[0].stations.back().position.y(), 3.0, 0.3);
}

TEST_F(LineFusion, WhereTheNetworkHardlySeesALineAMissSaysLittle) {
  for (int i = 0; i < 5; ++i) see({straight({0, 0, 0}, {20, 0, 0})});
  const double known = lines_[0].stations[5].log_odds;
  see({});
  const double lost = known - lines_[0].stations[5].log_odds;
  for (int i = 0; i < 3000; ++i) model_.learn_rate(MarkingType::laneline, {5, 0, 0}, i % 4 == 0);
  see({});
  EXPECT_LT(known - lost - lines_[0].stations[5].log_odds, 0.3 * lost);
}

TEST_F(LineFusion, EvidenceGrowsAndFallsAndTheLineGoes) {
  for (int i = 0; i < 5; ++i) see({straight({0, 0, 0}, {20, 0, 0})});
  const double known = lines_[0].stations[5].log_odds;
  EXPECT_GT(known, config_.publish_log_odds);
  see({});
  EXPECT_LT(lines_[0].stations[5].log_odds, known);
  for (int i = 0; i < 60; ++i) see({});
  EXPECT_TRUE(lines_.empty());
}

TEST_F(LineFusion, WhatCannotBeSeenLosesNothing) {
  for (int i = 0; i < 5; ++i) see({straight({0, 0, 0}, {20, 0, 0})});
  const double known = lines_[0].stations[5].log_odds;
  frame_.occluded_areas = {{{-1, -1, 0}, {25, -1, 0}, {25, 1, 0}, {-1, 1, 0}}};
  see({});
  EXPECT_EQ(lines_[0].stations[5].log_odds, known);
  frame_.occluded_areas.clear();
  frame_.detected_types = {MarkingType::stopline};
  see({});
  EXPECT_EQ(lines_[0].stations[5].log_odds, known);
  frame_.detected_types.clear();
  frame_.field_of_view = {{-20, -20, 0}, {-1, -20, 0}, {-1, 20, 0}, {-20, 20, 0}};  // behind
  see({});
  EXPECT_EQ(lines_[0].stations[5].log_odds, known);
}

TEST_F(LineFusion, ALineIsExtendedAtBothEndsWithoutAStep) {
  for (int i = 0; i < 10; ++i) see({straight({5, 0, 0}, {15, 0, 0})});
  see({straight({0, 0.3, 0}, {25, 0.3, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  const auto& stations = lines_[0].stations;
  EXPECT_NEAR(stations.front().position.x(), 0.0, 0.01);
  EXPECT_NEAR(stations.back().position.x(), 25.0, 0.01);
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const bool extension = stations[i].position.x() < 5.0 || stations[i - 1].position.x() > 14.9;
    if (extension) {
      EXPECT_LT(std::abs(stations[i].position.y() - stations[i - 1].position.y()), 0.1);
    }
    EXPECT_GT(stations[i].position.x(), stations[i - 1].position.x());
  }
}

TEST_F(LineFusion, AnEndThatIsNotSeenAgainIsCut) {
  see({straight({0, 0, 0}, {25, 0, 0})});
  for (int i = 0; i < 30; ++i) see({straight({0, 0, 0}, {15, 0, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_NEAR(lines_[0].stations.back().position.x(), 15.0, 1.01);
}

TEST_F(LineFusion, ALineThatIsLostInBetweenIsSplit) {
  for (int i = 0; i < 10; ++i) see({straight({0, 0, 0}, {25, 0, 0})});
  const ElementId id = lines_[0].id;
  for (int i = 0; i < 80; ++i) see({straight({0, 0, 0}, {8, 0, 0}), straight({14, 0, 0}, {25, 0, 0})});
  ASSERT_EQ(lines_.size(), 2U);
  EXPECT_EQ(std::ranges::count(lines_, id, &Line::id), 1);
  ASSERT_EQ(cut_off_.size(), 1U);
  EXPECT_EQ(std::ranges::count(lines_, cut_off_[0].id, &Line::id), 1);
  EXPECT_EQ(cut_off_[0].other, id);
}

TEST_F(LineFusion, TheTypeIsThatOfMostObservations) {
  see({straight({0, 0, 0}, {20, 0, 0})}, MarkingType::roadedge);
  for (int i = 0; i < 3; ++i) see({straight({0, 0, 0}, {20, 0, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].type(), MarkingType::laneline);
}

TEST_F(LineFusion, APlaceThatIsConfusedForSecondsKeepsItsType) {
  for (int i = 0; i < 60; ++i) see({straight({0, 0, 0}, {20, 0, 0})});
  for (int i = 0; i < 50; ++i) see({straight({0, 0, 0}, {20, 0, 0})}, MarkingType::roadedge);
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].type(), MarkingType::laneline);
}

TEST_F(LineFusion, ALineThatBecomesAnEdgeIsOneWhereTheVehicleHasArrived) {
  for (int i = 0; i < 600; ++i) see({straight({-10, 0, 0}, {10, 0, 0})});
  see({straight({-10, 0, 0}, {10, 0, 0})});
  for (double x = 10; x < 60; x += 1.0) {
    range_ = geometry::MapBox(RangeConfig{}, Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)));
    see({straight({x, 0, 0}, {x + 20, 0, 0})}, MarkingType::roadedge);
  }
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_EQ(lines_[0].type(), MarkingType::roadedge);
}

TEST_F(LineFusion, NothingIsKeptBeyondTheRange) {
  see({straight({-60, 0, 0}, {90, 0, 0})});
  ASSERT_EQ(lines_.size(), 1U);
  EXPECT_GE(lines_[0].stations.front().position.x(), -30.0);  // 5 m and a margin of 25 m
  EXPECT_LE(lines_[0].stations.back().position.x(), 55.0);
}

}  // namespace
}  // namespace laneloom::lines
