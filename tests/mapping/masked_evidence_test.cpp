#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "mapping/mapped_road.hpp"

namespace laneloom {
namespace {

/// What comes beside the detections.
struct Given {
  bool traffic = true, sd_map = true;
};

/// A vehicle drives along the road, in a one-way street of the SD map; others come against it on its left.
class MaskedDrive {
 public:
  MaskedDrive(const EvidenceConfig& evidence, Given given) : mapper_(config(evidence), sd_map(given)) {
    for (int i = 1; i <= 60; ++i) {
      const double x = i * test::kStep_m;
      if (given.traffic) mapper_.add(oncoming(x, i), test::at(x));
      mapper_.update(test::frame_at(x, test::road(), i), test::at(x));
    }
  }

  const LocalMap& map() const { return mapper_.map(); }
  std::string bytes() const { return mapper_.save(); }

  /// Everything on which something of the map rests.
  Evidence all_evidence() const {
    Evidence all = Evidence::none;
    for (const Lane& lane : map().lanes) all |= lane.evidence | lane.direction_evidence;
    for (const Linkage& linkage : map().linkages) all |= linkage.evidence;
    return all;
  }

 private:
  static MapperConfig config(const EvidenceConfig& evidence) {
    MapperConfig config;
    config.evidence = evidence;
    return config;
  }
  static SdMap sd_map(Given given) {
    if (!given.sd_map) return {};
    return SdMap({{.id = 1, .nodes = {1, 2}, .points = {{-100, -1.8}, {400, -1.8}}, .oneway = true}}, {});
  }
  static TrackedObjects oncoming(double x, int number) {
    const double met_m = 60.0 - 2.0 * x;  // ahead of the vehicle
    return {.stamp_ns = number * 100'000'000LL,
            .objects = {{.id = 1,
                         .kind = ObjectKind::car,
                         .position = {met_m, 1.9, 0.0},
                         .heading = {-1.0, 0.0, 0.0},
                         .speed_mps = 10.0}}};
  }

  Mapper mapper_;
};

TEST(MaskedEvidence, EachKindTellsSomethingUnlessItIsMasked) {
  const Evidence all = MaskedDrive({}, {}).all_evidence();
  for (const Evidence kind : {Evidence::traffic, Evidence::sd_map, Evidence::ego_path})
    EXPECT_TRUE(overlap(all, kind)) << static_cast<int>(kind);
  EXPECT_FALSE(overlap(MaskedDrive({.traffic = false}, {}).all_evidence(), Evidence::traffic));
  EXPECT_FALSE(overlap(MaskedDrive({.sd_map = false}, {}).all_evidence(), Evidence::sd_map));
  EXPECT_FALSE(overlap(MaskedDrive({.ego_path = false}, {}).all_evidence(), Evidence::ego_path));
}

TEST(MaskedEvidence, AMaskedKindIsAsIfItHadNeverCome) {
  EXPECT_EQ(MaskedDrive({.traffic = false}, {}).bytes(), MaskedDrive({}, {.traffic = false}).bytes());
  EXPECT_EQ(MaskedDrive({.sd_map = false}, {}).bytes(), MaskedDrive({}, {.sd_map = false}).bytes());
}

TEST(MaskedEvidence, WithoutTheOwnDriveARoadStillHasItsLanes) {
  const MaskedDrive drive({.ego_path = false}, {.traffic = false, .sd_map = false});
  EXPECT_EQ(drive.map().lanes.size(), 2U);
  EXPECT_TRUE(drive.map().way.has_value());
}

}  // namespace
}  // namespace laneloom
