#include "mapping/geometry/oriented_groups.hpp"

#include <gtest/gtest.h>

namespace laneloom::geometry {
namespace {

TEST(OrientedGroups, JoinedTheyKnowWhoRunsAgainstWhom) {
  OrientedGroups groups(5);
  groups.join(3, 4, true);
  groups.join(1, 2, false);
  groups.join(4, 1, true);
  EXPECT_EQ(groups.group(0), 0U);
  for (const std::size_t i : {1U, 2U, 3U, 4U}) EXPECT_EQ(groups.group(i), 1U);
  EXPECT_TRUE(groups.opposed(3, 4));
  EXPECT_TRUE(groups.opposed(4, 2));
  EXPECT_FALSE(groups.opposed(3, 2));
}

TEST(OrientedGroups, WhatIsKnownStays) {
  OrientedGroups groups(3);
  groups.join(0, 1, false);
  groups.join(1, 2, false);
  groups.join(0, 2, true);
  EXPECT_FALSE(groups.opposed(0, 2));
}

}  // namespace
}  // namespace laneloom::geometry
