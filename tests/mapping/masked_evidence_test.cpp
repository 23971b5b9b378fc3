#include <gtest/gtest.h>

#include "mapping/mapped_road.hpp"

namespace laneloom {
namespace {

using test::Drive;

/// The inputs that a drive has beside its detections.
struct Given {
  bool traffic = true, sd_map = true;
};

/// A one-way street along the road.
SdMap one_way_street() {
  return SdMap({{.id = 1, .nodes = {1, 2}, .points = {{-100, -1.8}, {400, -1.8}}, .oneway = true}}, {});
}

/// A car that comes towards the vehicle in the left lane, at the next frame of a drive.
TrackedObjects oncoming(const Drive& drive) {
  const int number = drive.number + 1;
  return {.stamp_ns = number * 100'000'000LL,
          .objects = {{.id = 1,
                       .kind = ObjectKind::car,
                       .position = {60.0 - 2.0 * number * test::kStep_m, 1.9, 0.0},
                       .heading = {-1.0, 0.0, 0.0},
                       .speed_mps = 10.0}}};
}

Drive masked_drive(const EvidenceConfig& evidence, Given given) {
  MapperConfig config;
  config.evidence = evidence;
  Drive drive(config, given.sd_map ? one_way_street() : SdMap());
  for (int i = 0; i < 60; ++i) {
    if (given.traffic) drive.mapper.add(oncoming(drive), test::at(drive.x + test::kStep_m));
    drive.step();
  }
  return drive;
}

/// Everything on which something of a drive's map rests.
Evidence all_evidence(const Drive& drive) {
  const LocalMap& map = drive.mapper.map();
  Evidence all = Evidence::none;
  for (const Lane& lane : map.lanes) all |= lane.evidence | lane.direction_evidence;
  for (const Linkage& linkage : map.linkages) all |= linkage.evidence;
  return all;
}

TEST(MaskedEvidence, EachKindTellsSomethingUnlessItIsMasked) {
  const Evidence all = all_evidence(masked_drive({}, {}));
  for (const Evidence kind : {Evidence::traffic, Evidence::sd_map, Evidence::ego_path})
    EXPECT_TRUE(overlap(all, kind)) << static_cast<int>(kind);
  EXPECT_FALSE(overlap(all_evidence(masked_drive({.traffic = false}, {})), Evidence::traffic));
  EXPECT_FALSE(overlap(all_evidence(masked_drive({.sd_map = false}, {})), Evidence::sd_map));
  EXPECT_FALSE(overlap(all_evidence(masked_drive({.ego_path = false}, {})), Evidence::ego_path));
}

TEST(MaskedEvidence, AMaskedKindIsAsIfItHadNeverCome) {
  const auto saved = [](const EvidenceConfig& evidence, Given given) {
    return masked_drive(evidence, given).mapper.save();
  };
  EXPECT_EQ(saved({.traffic = false}, {}), saved({}, {.traffic = false}));
  EXPECT_EQ(saved({.sd_map = false}, {}), saved({}, {.sd_map = false}));
}

TEST(MaskedEvidence, WithoutTheOwnDriveARoadStillHasItsLanes) {
  const Drive drive = masked_drive({.ego_path = false}, {.traffic = false, .sd_map = false});
  EXPECT_EQ(drive.mapper.map().lanes.size(), 2U);
  EXPECT_TRUE(drive.mapper.map().way.has_value());
}

}  // namespace
}  // namespace laneloom
