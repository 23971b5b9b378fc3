#include "mapping/boundaries/islands.hpp"

#include <gtest/gtest.h>

#include "mapping/shapes.hpp"

namespace laneloom::boundaries {
namespace {

using test::arc;
using test::straight;

std::optional<Side> island_beside(const Polyline& line) { return island_side(MeasuredPolyline(line)); }

TEST(Islands, ALineThatTurnsEverywhereBoundsAnIslandOnItsInnerSide) {
  for (const double radius_m : {5.0, 10.0, 22.0})
    for (const double turn_deg : {140.0, 200.0, 359.0}) {
      SCOPED_TRACE(testing::Message() << radius_m << " m, " << turn_deg << " degrees");
      EXPECT_EQ(island_beside(arc({3, 4, 0}, radius_m, 20.0, 20.0 + turn_deg)), Side::left);
      EXPECT_EQ(island_beside(arc({3, 4, 0}, radius_m, 20.0, 20.0 - turn_deg)), Side::right);
    }
}

TEST(Islands, AnIslandMayBeSeenWithNoise) {
  Polyline kerb = arc({0, 0, 0}, 12.0, 0.0, 250.0);
  for (std::size_t i = 0; i < kerb.size(); ++i) kerb[i] *= i % 3 == 0 ? 1.01 : 0.99;
  EXPECT_EQ(island_beside(kerb), Side::left);
}

TEST(Islands, OtherKerbsBoundNone) {
  EXPECT_EQ(island_beside(straight({0, 0, 0}, {50, 0, 0})), std::nullopt);
  EXPECT_EQ(island_beside(arc({0, 0, 0}, 12.0, 0.0, 90.0)), std::nullopt) << "the corner of a street";
  EXPECT_EQ(island_beside(arc({0, 0, 0}, 60.0, 0.0, 200.0)), std::nullopt) << "a ramp";
  EXPECT_EQ(island_beside(arc({0, 0, 0}, 1.0, 0.0, 180.0)), std::nullopt) << "the nose of a median";
  Polyline hairpin = straight({-30, -10, 0}, {0, -10, 0}, 30);
  const Polyline bend = arc({0, 0, 0}, 10.0, -90.0, 90.0), back = straight({0, 10, 0}, {-30, 10, 0}, 30);
  hairpin.insert(hairpin.end(), bend.begin() + 1, bend.end());
  hairpin.insert(hairpin.end(), back.begin() + 1, back.end());
  EXPECT_EQ(island_beside(hairpin), std::nullopt);
}

}  // namespace
}  // namespace laneloom::boundaries
