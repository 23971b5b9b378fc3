#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "contract/contract.hpp"
#include "laneloom/mapper.hpp"
#include "published.hpp"
#include "simulation/perception.hpp"
#include "simulation/scenarios.hpp"

/// Whatever the noise, no map breaks what a planner relies on.
namespace laneloom {
namespace {

constexpr double kMaxOverlapping = 0.1;  // share of the maps in which lanes overlap

struct Noisy {
  const char* scenario;
  const char* noise;
  FusionMethod method;
  std::uint64_t seed;
};

void PrintTo(const Noisy& noisy, std::ostream* out) {
  *out << noisy.scenario << " " << noisy.noise << " "
       << (noisy.method == FusionMethod::lines ? "lines" : "voxels") << " " << noisy.seed;
}

class NoisyContract : public ::testing::TestWithParam<Noisy> {};

TEST_P(NoisyContract, IsKept) {
  const auto& [scenario, noise, method, seed] = GetParam();
  const simulation::Road road = simulation::make_scenario(scenario);
  simulation::Perception perception(road, simulation::noise_profile(noise), simulation::SensorView{}, seed);
  MapperConfig config;
  config.method = method;
  config.lane.publish_side_strips = true;  // the lanes are the same with them
  Mapper mapper(config);
  std::size_t lanes = 0;
  int frames = 0, overlapping = 0;
  std::optional<PublishedMap> previous;
  for (int i = 1; i < static_cast<int>(road.drive.duration_s() * 10.0); ++i) {
    const VehiclePose pose = road.drive.pose_at(0.1 * i);
    PublishedMap published = test::published(mapper.update(perception.observe(pose), transform(pose)),
                                             static_cast<std::uint64_t>(i));
    lanes += published.map.lanes.size();
    for (const contract::Violation& violation :
         contract::check_contract(published, previous ? &*previous : nullptr)) {
      ADD_FAILURE() << "frame " << i << ": " << name(violation.rule) << ": " << violation.detail;
    }
    ++frames;
    if (!contract::check_lanes_apart(published.map).empty()) ++overlapping;
    previous = std::move(published);
  }
  EXPECT_GT(lanes, 50U);
  EXPECT_LE(overlapping, kMaxOverlapping * frames);
}

INSTANTIATE_TEST_SUITE_P(Drives, NoisyContract,
                         ::testing::Values(Noisy{"town", "inhouse", FusionMethod::voxels, 1},
                                           Noisy{"town", "inhouse", FusionMethod::lines, 2},
                                           Noisy{"town", "av2", FusionMethod::lines, 3},
                                           Noisy{"town", "inhouse", FusionMethod::lines, 101},
                                           Noisy{"town", "av2", FusionMethod::lines, 1},
                                           Noisy{"street", "av2", FusionMethod::lines, 6},
                                           Noisy{"motorway", "inhouse", FusionMethod::lines, 9},
                                           Noisy{"median", "av2", FusionMethod::lines, 5},
                                           Noisy{"overpass", "av2", FusionMethod::lines, 2},
                                           Noisy{"intersection", "inhouse", FusionMethod::lines, 4},
                                           Noisy{"street", "inhouse", FusionMethod::lines, 7},
                                           Noisy{"country_road", "av2", FusionMethod::lines, 8},
                                           Noisy{"motorway", "inhouse", FusionMethod::lines, 9},
                                           Noisy{"exit", "inhouse", FusionMethod::lines, 10},
                                           Noisy{"entry", "av2", FusionMethod::lines, 11},
                                           Noisy{"curve", "av2", FusionMethod::lines, 5},
                                           Noisy{"overpass", "inhouse", FusionMethod::voxels, 6}));

}  // namespace
}  // namespace laneloom
