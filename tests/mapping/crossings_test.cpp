#include "mapping/crossings.hpp"

#include <gmock/gmock.h>

#include "laneloom/polyline.hpp"
#include "mapping/shapes.hpp"

namespace laneloom {
namespace {

using test::straight;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Pair = std::pair<ElementId, ElementId>;

Lane lane(ElementId id, Polyline centerline) {
  Lane l;
  l.id = id;
  l.centerline = std::move(centerline);
  return l;
}

std::vector<Linkage> crossings(const std::vector<Lane>& lanes, std::vector<Linkage> known = {},
                               const LinkageConfig& config = {}) {
  link_across_intersections(lanes, config, known);
  return known;
}

std::vector<Pair> pairs(const std::vector<Linkage>& linkages) {
  std::vector<Pair> result;
  for (const Linkage& l : linkages) result.emplace_back(l.from, l.to);
  return result;
}

TEST(Crossings, EachLaneGoesOnInTheOneAheadOfIt) {
  const auto linkages =
      crossings({lane(1, straight({0, 0, 0}, {10, 0, 0})), lane(2, straight({0, 3.5, 0}, {10, 3.5, 0})),
                 lane(3, straight({30, 0.4, 0}, {40, 0.4, 0})), lane(4, straight({30, 3.9, 0}, {40, 3.9, 0})),
                 lane(5, straight({20, -20, 0}, {20, -10, 0}))});
  EXPECT_THAT(pairs(linkages), ElementsAre(Pair(1, 3), Pair(2, 4)));
  for (const Linkage& linkage : linkages) {
    EXPECT_EQ(linkage.kind, Linkage::Kind::intersection);
    EXPECT_EQ(linkage.turn, Linkage::Turn::straight);
    EXPECT_GT(linkage.confidence, 0.5);
    EXPECT_LT(linkage.confidence, 0.9);
  }
}

TEST(Crossings, ThePathLeadsFromEndToBeginWithoutAKink) {
  const auto linkages =
      crossings({lane(1, straight({0, 0, 0}, {10, 0, 1})), lane(2, straight({30, 1, 2}, {40, 1.5, 2}))});
  ASSERT_EQ(linkages.size(), 1U);
  const Polyline& path = linkages[0].path;
  EXPECT_TRUE(path.front().isApprox(Point(10, 0, 1)));
  EXPECT_TRUE(path.back().isApprox(Point(30, 1, 2)));
  EXPECT_GT(end_direction(path, false, 1.0).dot(Eigen::Vector2d(-1, 0)), 0.995);
  for (std::size_t i = 2; i < path.size(); ++i) {
    const Eigen::Vector2d before = (path[i - 1] - path[i - 2]).head<2>().normalized();
    const Eigen::Vector2d after = (path[i] - path[i - 1]).head<2>().normalized();
    EXPECT_GT(before.dot(after), 0.99);
  }
}

TEST(Crossings, NotTooFarAsideOrAround) {
  const Lane from = lane(1, straight({0, 0, 0}, {10, 0, 0}));
  EXPECT_THAT(crossings({from, lane(2, straight({46, 0, 0}, {50, 0, 0}))}), IsEmpty());
  EXPECT_THAT(crossings({from, lane(2, straight({30, 2, 0}, {40, 2, 0}))}), IsEmpty());
  EXPECT_THAT(crossings({from, lane(2, straight({30, 0, 0}, {40, 6, 0}))}), IsEmpty());
  EXPECT_THAT(crossings({from, lane(2, straight({40, 0, 0}, {30, 0, 0}))}), IsEmpty());
  LinkageConfig never;
  never.max_crossing_gap_m = 0.0;
  EXPECT_THAT(crossings({from, lane(2, straight({30, 0, 0}, {40, 0, 0}))}, {}, never), IsEmpty());
}

TEST(Crossings, LanesThatMarkingsLinkAreLeftAlone) {
  const std::vector<Lane> lanes{lane(1, straight({0, 0, 0}, {10, 0, 0})),
                                lane(2, straight({11, 0, 0}, {18, 0, 0})),
                                lane(3, straight({30, 0, 0}, {40, 0, 0}))};
  const auto linkages = crossings(lanes, {{.from = 1, .to = 2}});
  EXPECT_THAT(pairs(linkages), ElementsAre(Pair(1, 2), Pair(2, 3)));
}

}  // namespace
}  // namespace laneloom
