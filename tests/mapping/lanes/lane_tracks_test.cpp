#include "mapping/lanes/lane_tracks.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "mapping/lanes/lane_evidence.hpp"
#include "mapping/shapes.hpp"

namespace laneloom::lanes {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A road of boundaries along x, and the lanes that each frame finds between them.
class Tracks : public ::testing::Test {
 protected:
  struct Found {
    double from_m = 0.0, to_m = 0.0;
    double y = 0.0;  ///< of the lane's center
    ElementId left = 1, right = 2;
    ElementStatus status = ElementStatus::confirmed;
    bool reversed = false;
  };

  static Lane lane(const Found& found) {
    const auto line = [&](double y) {
      Polyline points = test::straight({found.from_m, y, 0}, {found.to_m, y, 0},
                                       static_cast<int>(found.to_m - found.from_m) + 1);
      if (found.reversed) std::ranges::reverse(points);
      return points;
    };
    const double side_m = found.reversed ? -1.75 : 1.75;
    const Stretch range{0.0, found.to_m - found.from_m}, on{found.from_m + 100.0, found.to_m + 100.0};
    Lane lane{.left = line(found.y + side_m), .right = line(found.y - side_m), .centerline = line(found.y)};
    lane.left_borders = {{found.reversed ? found.right : found.left, range, on, found.reversed}};
    lane.right_borders = {{found.reversed ? found.left : found.right, range, on, found.reversed}};
    lane.width_m = 3.5;
    lane.status = found.status;
    lane.existence_probability = 0.9;
    return lane;
  }

  std::vector<Lane> frame(const std::vector<Found>& found, std::vector<Fork> forks = {},
                          std::vector<DeniedStretch> denied = {}) {
    LaneLayout layout{
        .boundaries = boundaries_, .lanes = {}, .forks = std::move(forks), .denied = std::move(denied)};
    for (const Found& one : found) layout.lanes.push_back(lane(one));
    lanes_ = tracks_.update(std::move(layout), test::scene(++frame_), {}, ids_).lanes;
    renamed_ = tracks_.publish(lanes_, ids_);
    return lanes_;
  }
  std::vector<ElementId> ids() const {
    std::vector<ElementId> ids;
    for (const Lane& lane : lanes_) ids.push_back(lane.id);
    return ids;
  }
  static boundaries::Boundaries lines(const std::vector<std::pair<ElementId, double>>& at) {
    std::vector<boundaries::LaneBoundary> lines;
    for (const auto& [id, y] : at)
      lines.push_back(test::boundary(id, test::straight({-100, y, 0}, {100, y, 0})));
    return lines;
  }

  boundaries::Boundaries boundaries_ = lines({{1, 1.75}, {2, -1.75}});
  LaneTracks tracks_;
  markings::IdSource ids_{100};
  std::uint64_t frame_ = 0;
  std::vector<Lane> lanes_;
  std::map<ElementId, ElementId> renamed_;
};

TEST_F(Tracks, ShowALaneBetweenConfirmedLinesAtOnce) {
  frame({{0, 30}});
  ASSERT_THAT(ids(), ElementsAre(100));
  EXPECT_NEAR(length(lanes_[0].centerline), 30.0, 1e-9);
  EXPECT_EQ(lanes_[0].status, ElementStatus::confirmed);
  EXPECT_EQ(lanes_[0].left_borders.front().boundary, 1U);
}

TEST_F(Tracks, ShowAnInferredLaneWhenItWasFoundSeveralTimes) {
  const Found inferred{.from_m = 0, .to_m = 30, .status = ElementStatus::inferred};
  int frames = 1;
  while (frame({inferred}).empty() && frames < 50) ++frames;
  EXPECT_GT(frames, 2);
  EXPECT_LT(frames, 10);
  EXPECT_EQ(lanes_[0].status, ElementStatus::inferred);
}

TEST_F(Tracks, KeepALaneThatAFrameDoesNotFind) {
  for (int i = 0; i < 5; ++i) frame({{0, 30}});
  for (int i = 0; i < 10; ++i) {
    frame({});
    EXPECT_THAT(ids(), ElementsAre(100)) << i;
  }
}

TEST_F(Tracks, HideALaneThatIsNotFoundForLong) {
  for (int i = 0; i < 100; ++i) frame({{0, 30}});
  int frames = 0;
  while (!frame({}).empty() && frames < 1000) ++frames;
  EXPECT_GT(frames, 20);
  EXPECT_LT(frames, 80);
  EXPECT_THAT(tracks_.all(), testing::SizeIs(1)) << "it is known for a little longer";
  for (int i = 0; i < 20; ++i) frame({});
  EXPECT_THAT(tracks_.all(), IsEmpty());
}

TEST_F(Tracks, HideALaneSoonerThatFramesDeny) {
  const auto frames_until_hidden = [&](const std::vector<DeniedStretch>& denied) {
    tracks_ = {};
    for (int i = 0; i < 20; ++i) frame({{0, 30}});
    int frames = 0;
    while (frames < 100 && !frame({}, {}, denied).empty()) ++frames;
    return frames;
  };
  const Polyline middle = test::straight({-10, 0.2, 0}, {40, 0.2, 0}, 51);
  EXPECT_GT(frames_until_hidden({}), 40) << "it is not seen";
  EXPECT_LT(frames_until_hidden({{{1, 2}, middle}}), 25);
  EXPECT_LT(frames_until_hidden({{{2, 1}, middle}}), 25) << "seen the other way round";
  EXPECT_GT(frames_until_hidden({{{1, 3}, middle}}), 40) << "between other lines";
  EXPECT_GT(frames_until_hidden({{{1, 2}, test::straight({-10, 3, 0}, {40, 3, 0}, 51)}}), 40) << "elsewhere";
}

TEST_F(Tracks, AHiddenLaneComesBackByItsId) {
  for (int i = 0; i < 20; ++i) frame({{0, 30}});
  while (!frame({}).empty()) {
  }
  frame({{0, 30}});
  for (int i = 0; i < 10 && lanes_.empty(); ++i) frame({{0, 30}});
  EXPECT_THAT(ids(), ElementsAre(100));
}

TEST_F(Tracks, AnotherLaneInItsPlaceEndsALaneSooner) {
  for (int i = 0; i < 100; ++i) frame({{0, 30}});
  int frames = 0;
  const Found aside{.from_m = 0, .to_m = 30, .y = 1.2};
  while (std::ranges::count(ids(), 100) > 0 && frames < 1000) {
    frame({aside});
    ++frames;
  }
  EXPECT_LT(frames, 20);
  EXPECT_THAT(ids(), ElementsAre(101));
}

TEST_F(Tracks, GoOnWhereTheLaneIsFoundFurther) {
  for (int i = 0; i < 10; ++i) {
    frame({{1.3 * i, 1.3 * i + 35}});
    ASSERT_THAT(ids(), ElementsAre(100));
  }
  EXPECT_NEAR(lanes_[0].centerline.back().x(), 1.3 * 9 + 35, 1.0);
}

TEST_F(Tracks, ALaneGoesOnWhereABoundaryChangesItsId) {
  std::vector<boundaries::LaneBoundary> lines{
      test::boundary(1, test::straight({-100, 1.75, 0}, {20, 1.75, 0})),
      test::boundary(2, test::straight({-100, -1.75, 0}, {100, -1.75, 0})),
      test::boundary(3, test::straight({20, 1.75, 0}, {100, 1.75, 0}))};
  boundaries_ = lines;
  for (int i = 0; i < 3; ++i) frame({{0, 20}, {20, 50, 0, 3, 2}});
  EXPECT_EQ(lanes_.size(), 2U) << "no frame shows that the one goes on in the other";
  for (int i = 0; i < 3; ++i) frame({{0, 50, 0, 1, 2}});
  for (int i = 0; i < 3; ++i) frame({{0, 20}, {20, 50, 0, 3, 2}});
  ASSERT_THAT(ids(), ElementsAre(100));
  EXPECT_NEAR(length(lanes_[0].centerline), 50.0, 1.0);
  std::vector<ElementId> left;
  for (const Border& border : lanes_[0].left_borders) left.push_back(border.boundary);
  EXPECT_THAT(left, ElementsAre(1, 3));
  EXPECT_EQ(lanes_[0].left_borders[0].range.to_m, lanes_[0].left_borders[1].range.from_m);
  EXPECT_EQ(lanes_[0].right_borders.size(), 1U);
}

TEST_F(Tracks, ABorderWhoseBoundaryIsGoneIsUnseen) {
  for (int i = 0; i < 5; ++i) frame({{0, 30}});
  boundaries_ = lines({{2, -1.75}});
  frame({});
  ASSERT_THAT(ids(), ElementsAre(100));
  EXPECT_EQ(lanes_[0].left_borders.front().boundary, kNoElement);
  EXPECT_EQ(lanes_[0].right_borders.front().boundary, 2U);
  EXPECT_EQ(lanes_[0].status, ElementStatus::inferred);
  EXPECT_NEAR(lanes_[0].width_m, 3.5, 1e-9);
}

TEST_F(Tracks, WhatIsNotFoundMovesWithWhatIs) {
  for (int i = 0; i < 5; ++i) frame({{0, 40}});
  boundaries_ = lines({{1, 2.05}, {2, -1.45}});
  frame({{.from_m = 0, .to_m = 20, .y = 0.3}});
  ASSERT_THAT(ids(), ElementsAre(100));
  EXPECT_NEAR(lanes_[0].centerline[5].y(), 0.3, 1e-9);
  EXPECT_GT(lanes_[0].centerline[22].y(), 0.2);
  for (std::size_t i = 1; i < lanes_[0].centerline.size(); ++i)
    EXPECT_LT(std::abs(lanes_[0].centerline[i].y() - lanes_[0].centerline[i - 1].y()), 0.05);
}

TEST_F(Tracks, ALaneWithAForkIsTwoOnceThatIsSure) {
  for (int i = 0; i < 5; ++i) frame({{0, 60}});
  const Fork fork{.branch = {1, Side::left}, .arc_m = 130.0};
  frame({{0, 30}, {30, 60}}, {fork});
  EXPECT_EQ(lanes_.size(), 1U) << "one frame is not enough";
  for (int i = 0; i < 5; ++i) frame({{0, 30}, {30, 60}}, {fork});
  ASSERT_EQ(lanes_.size(), 2U);
  const std::vector<ElementId> two = ids();
  frame({{0, 60}});
  EXPECT_EQ(ids(), two) << "one frame without the fork does not join them";
  for (int i = 0; i < 20; ++i) frame({{0, 60}});
  EXPECT_EQ(lanes_.size(), 1U);
}

TEST_F(Tracks, RunAsTheRoadDoesAndRememberTheDirection) {
  frame({{0, 30}});
  tracks_.find(100)->direction_log_odds = 2.0;
  frame({{.from_m = 0, .to_m = 30, .reversed = true}});
  ASSERT_THAT(ids(), ElementsAre(100));
  EXPECT_EQ(tracks_.find(100)->direction_log_odds, 2.0) << "its boundaries run as before";
}

TEST_F(Tracks, ALaneThatIsTurnedRoundIsAnotherLane) {
  const auto publish = [&](bool turned) {
    LaneLayout layout{.boundaries = boundaries_, .lanes = {lane({0, 30})}};
    std::vector<Lane> lanes = tracks_.update(std::move(layout), test::scene(++frame_), {}, ids_).lanes;
    if (turned) std::ranges::reverse(lanes[0].centerline);
    return tracks_.publish(lanes, ids_);
  };
  EXPECT_THAT(publish(true), IsEmpty()) << "a new lane runs as it likes";
  EXPECT_THAT(publish(true), IsEmpty());
  EXPECT_THAT(publish(false), ElementsAre(testing::Pair(100, 101)));
  EXPECT_EQ(tracks_.find(100), nullptr);
  EXPECT_THAT(publish(false), IsEmpty());
  EXPECT_NE(tracks_.find(101), nullptr);
}

TEST_F(Tracks, TwoLanesInOnePlaceBecomeOne) {
  for (int i = 0; i < 5; ++i) frame({{0, 30}});
  const Found aside{.from_m = 0, .to_m = 30, .y = 1.2};
  frame({{0, 30}, aside});
  ASSERT_EQ(tracks_.all().size(), 2U);
  for (int i = 0; i < 5; ++i) frame({{.from_m = 0, .to_m = 30, .y = 0.6}});
  EXPECT_THAT(ids(), ElementsAre(100));
}

TEST_F(Tracks, LanesKeepTheirIdsWhileALongStretchBetweenThemIsHidden) {
  frame({{-25, 25}});
  const auto end_m = [&] { return lanes_.front().centerline.back().x(); };
  for (int i = 0; i < 100 && end_m() > 10.0; ++i) frame({{-25, 5}});
  ASSERT_LT(end_m(), 10.0);
  frame({{-25, 5}, {28, 50}});
  ASSERT_THAT(ids(), ElementsAre(100, 101));
  frame({{-25, 50}});
  EXPECT_THAT(ids(), ElementsAre(100, 101)) << "what lies between them is not shown yet";
  for (int i = 0; i < 5; ++i) frame({{-25, 50}});
  EXPECT_THAT(ids(), ElementsAre(100));
  EXPECT_NEAR(length(lanes_[0].centerline), 75.0, 1.0);
}

TEST_F(Tracks, TheLaneThatWasShownKeepsItsIdWhereAHiddenOneJoinsIt) {
  frame({{.from_m = 0, .to_m = 20, .status = ElementStatus::inferred}});
  frame({{25, 50}});
  ASSERT_THAT(ids(), ElementsAre(101));
  frame({{0, 50}});
  EXPECT_THAT(ids(), ElementsAre(101));
}

TEST_F(Tracks, EndWithTheBox) {
  frame({{-30, 30}});
  LaneLayout nothing{.boundaries = boundaries_};
  const geometry::Scene far{.box = geometry::MapBox({}, test::at(500)), .frame = ++frame_};
  EXPECT_THAT(tracks_.update(std::move(nothing), far, {}, ids_).lanes, IsEmpty());
  EXPECT_THAT(tracks_.all(), IsEmpty());
}

}  // namespace
}  // namespace laneloom::lanes
