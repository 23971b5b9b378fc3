#include "mapping/lines/line_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/shapes.hpp"

namespace laneloom::lines {
namespace {

using test::straight;

void believe(Line& line, double log_odds) {
  for (Station& station : line.stations) station.log_odds = log_odds;
}

std::size_t count_of(ElementId id, const std::vector<Line>& lines) {
  return static_cast<std::size_t>(std::ranges::count(lines, id, &Line::id));
}

TEST(LineRoom, NoMoreThan256LinesAreKept) {
  std::vector<Line> lines;
  for (ElementId id = 1; id <= 300; ++id) {
    const double x = -40.0 + 4.0 * static_cast<double>(id % 15),
                 y = -40.0 + 4.0 * static_cast<double>(id / 15);
    lines.push_back(test::line(id, straight({x, y, 0}, {x + 3.0, y, 0})));
  }
  believe(lines.back(), 1.0);
  EXPECT_EQ(keep_within_room(lines), 44U);
  EXPECT_EQ(lines.size(), 256U);
  EXPECT_EQ(count_of(300, lines), 1U) << "is believed most";
  EXPECT_EQ(count_of(1, lines), 1U) << "is the first of equals";
}

TEST(LineRoom, NoMoreThan20000StationsAreKept) {
  std::vector<Line> lines;
  for (ElementId id = 1; id <= 60; ++id) {
    const double y = static_cast<double>(id);
    lines.push_back(test::line(id, straight({-20, y, 0}, {20, y, 0}, 500)));
  }
  believe(lines.back(), 1.0);
  EXPECT_EQ(keep_within_room(lines), 20U);
  EXPECT_EQ(lines.size(), 40U);
  EXPECT_EQ(lines.front().id, 1U);
  EXPECT_EQ(lines.back().id, 60U) << "is believed most";
}

TEST(LineRoom, NoMoreThanFourLinesAreKeptInASquareMetre) {
  std::vector<Line> lines;
  for (ElementId id = 1; id <= 12; ++id) {
    const double y = 0.05 * static_cast<double>(id);
    lines.push_back(test::line(id, straight({0.5, y, 0}, {20.5, y, 0}, 21)));
  }
  lines.push_back(test::line(13, straight({5.5, -9.5, 0}, {5.5, 10.5, 0}, 41)));  // across the heap
  believe(lines.back(), 1.0);
  lines.push_back(test::line(14, straight({0, 3, 0}, {20, 3, 0}, 21)));  // beside it
  believe(lines.back(), -1.0);
  EXPECT_EQ(keep_within_room(lines), 9U);
  EXPECT_EQ(count_of(13, lines), 1U) << "is believed most";
  EXPECT_EQ(count_of(14, lines), 1U) << "has room";
  EXPECT_EQ(count_of(3, lines), 1U);
  EXPECT_EQ(count_of(4, lines), 0U) << "is the fifth where the line across lies";
}

TEST(LineRoom, FourLinesInOnePlaceAreAllKept) {
  std::vector<Line> lines;
  for (ElementId id = 1; id <= 4; ++id)
    lines.push_back(test::line(id, straight({0, 0.1, 0}, {20, 0.1, 0}, 21)));
  lines.push_back(test::line(5, straight({0, 5, 0}, {20, 5, 0})));
  EXPECT_EQ(keep_within_room(lines), 0U);
  EXPECT_EQ(lines.size(), 5U);
}

}  // namespace
}  // namespace laneloom::lines
