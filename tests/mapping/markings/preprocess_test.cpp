#include "mapping/markings/preprocess.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "mapping/shapes.hpp"

namespace laneloom::markings {
namespace {

using test::arc;
using test::detection;
using test::straight;

DetectionFrame frame_of(std::vector<Detection> detections) {
  DetectionFrame frame;
  frame.detections = std::move(detections);
  return frame;
}

TEST(DropUnsure, KeepsTheThresholdAndDropsWhatIsBelow) {
  auto weak = detection(MarkingType::laneline, straight({0, 0, 0}, {10, 0, 0}));
  auto enough = weak;
  weak.confidence = 0.2999;
  enough.confidence = 0.3;
  auto markings = preprocess(frame_of({weak, enough}), test::at(0), {});
  EXPECT_EQ(drop_unsure({}, markings), 1U);
  ASSERT_EQ(markings.size(), 1U);
  EXPECT_EQ(markings[0].confidence, 0.3);
}

TEST(Preprocess, DropsWhatIsNoLine) {
  const auto point = detection(MarkingType::laneline, {{0, 0, 0}});
  EXPECT_TRUE(preprocess(frame_of({point}), test::at(0), {}).empty());
}

TEST(Preprocess, TransformsToTheMapFrame) {
  const auto line = detection(MarkingType::roadedge, straight({2, 1, 0.5}, {4, 1, 0.5}), MarkingStyle::solid);
  const auto markings = preprocess(frame_of({line}), test::at(10, 20, std::numbers::pi / 2), {});
  ASSERT_EQ(markings.size(), 1U);
  EXPECT_EQ(markings[0].type, MarkingType::roadedge);
  EXPECT_EQ(markings[0].style, MarkingStyle::solid);
  EXPECT_TRUE(markings[0].points[0].isApprox(Point(9, 22, 0.5)));
  EXPECT_TRUE(markings[0].points[1].isApprox(Point(9, 24, 0.5)));
}

constexpr MarkingType kLine = MarkingType::laneline, kEdge = MarkingType::roadedge;

TEST(Zigzag, OneTurnIsACornerTwoAreAZigzag) {
  const Polyline corner{{0, 0, 0}, {5, 0, 0}, {5, 5, 0}};
  const Polyline zigzag{{0, 0, 0}, {5, 0, 0}, {4, 2, 0}, {9, 2, 0}};
  for (const MarkingType type : {kLine, kEdge}) {
    EXPECT_FALSE(is_zigzag(corner, type, {}));
    EXPECT_TRUE(is_zigzag(zigzag, type, {}));
  }
}

TEST(Zigzag, TheOutlineOfAnIslandIsNone) {
  const Polyline whole{{0, 0, 0}, {14, 0, 0}, {14, 2, 0}, {0, 2, 0}, {0, 0, 0}};
  const Polyline seen_in_part{{0, 0, 0}, {14, 0, 0}, {14, 2, 0}, {0, 2, 0}};
  const Polyline triangle{{0, 0, 0}, {8, 1, 0}, {0, 2, 0}, {0, 0, 0}};
  for (Polyline outline : {whole, seen_in_part, triangle}) {
    EXPECT_FALSE(is_zigzag(outline, kEdge, {}));
    EXPECT_TRUE(is_zigzag(outline, kLine, {})) << "no line is an outline";
    std::reverse(outline.begin(), outline.end());
    EXPECT_FALSE(is_zigzag(outline, kEdge, {}));
  }
  // A network's mistake that comes back to where it began.
  const Polyline zigzag{{0, 0, 0}, {4, 0, 0}, {3, 2, 0}, {8, 2, 0}, {7, 4, 0}, {0, 4, 0}, {0, 1, 0}};
  EXPECT_TRUE(is_zigzag(zigzag, kEdge, {}));
}

TEST(Zigzag, AKerbMayHaveSquareCorners) {
  const Polyline steps_aside{{0, 0, 0}, {9, 0, 0}, {9, -2, 0}, {20, -2, 0}};
  const Polyline bay{{0, 0, 0}, {9, 0, 0}, {10, -3, 0}, {25, -3, 0}, {26, 0, 0}, {40, 0, 0}};
  for (const Polyline& kerb : {steps_aside, bay}) {
    EXPECT_FALSE(is_zigzag(kerb, kEdge, {}));
    EXPECT_TRUE(is_zigzag(kerb, kLine, {})) << "no paint is laid like that";
  }
}

TEST(Zigzag, ABendIsNone) { EXPECT_FALSE(is_zigzag(arc({0, 0, 0}, 12, 0, 180), kLine, {})); }

TEST(Zigzag, ShortSegmentsCarryNoAngle) {
  // A jag of 0.1 m on a straight line, as a network makes it.
  const Polyline jagged{{0, 0, 0}, {5, 0, 0}, {5.05, 0.1, 0}, {5.1, 0, 0}, {10, 0, 0}};
  EXPECT_FALSE(is_zigzag(jagged, kLine, {}));
}

TEST(Zigzag, CanBeSwitchedOff) {
  PreprocessConfig config;
  config.reject_zigzag = false;
  const auto zigzag = detection(MarkingType::laneline, {{0, 0, 0}, {5, 0, 0}, {4, 2, 0}, {9, 2, 0}});
  EXPECT_EQ(preprocess(frame_of({zigzag}), test::at(0), config).size(), 1U);
  EXPECT_TRUE(preprocess(frame_of({zigzag}), test::at(0), {}).empty());
}

}  // namespace
}  // namespace laneloom::markings
