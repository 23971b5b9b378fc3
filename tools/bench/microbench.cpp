// Micro-benchmarks of every stage of the mapper, and of the steps between it and the wire or a file. Each
// iteration of a stage is one more frame of a drive through the town, timed by itself.
#include <benchmark/benchmark.h>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "bench/guard_load.hpp"
#include "dds/rtps_guard.hpp"
#include "experiment/drive_simulation.hpp"
#include "io/json_lines.hpp"
#include "laneloom/dds/cdr.hpp"
#include "laneloom/mapper.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/way.hpp"
#include "simulation/scenarios.hpp"

namespace laneloom::bench {
namespace {

constexpr const char* kFrameId = "map";

/// A minute of the default load.
const std::vector<experiment::SimulatedFrame>& frames() {
  static const std::vector<experiment::SimulatedFrame> drive = experiment::simulate(
      {.road = std::make_shared<const simulation::Road>(simulation::make_scenario("town", 10.0)),
       .noise = simulation::noise_profile("inhouse"),
       .duration_s = 60.0});
  return drive;
}

/// The time of one stage in the last update.
class OneStage : public StageObserver {
 public:
  explicit OneStage(Stage stage) : stage_(stage) {}
  void update_begins() override {
    elapsed_ = Clock::duration::zero();
    start_ = Clock::now();
  }
  void stage_done(Stage stage) override {
    const Clock::time_point now = Clock::now();
    if (stage == stage_) elapsed_ += now - start_;
    start_ = now;
  }
  double seconds() const { return std::chrono::duration<double>(elapsed_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Stage stage_;
  Clock::time_point start_;
  Clock::duration elapsed_{};
};

void stage(benchmark::State& state, Stage stage, const MapperConfig& config) {
  Mapper mapper(config);
  OneStage watch(stage);
  std::size_t next = 0;
  for ([[maybe_unused]] auto iteration : state) {
    if (next == frames().size()) {
      mapper.reset();
      next = 0;
    }
    const io::FrameRecord& record = frames()[next++].record;
    mapper.update(record.frame, transform(record.pose), &watch);
    state.SetIterationTime(watch.seconds());
  }
}

/// The map after the drive.
const PublishedMap& last_map() {
  static const PublishedMap published = [] {
    Mapper mapper(MapperConfig{});
    for (const experiment::SimulatedFrame& frame : frames())
      mapper.update(frame.record.frame, transform(frame.record.pose));
    PublishedMap map;
    map.frame_id = kFrameId;
    map.map = mapper.map();
    return map;
  }();
  return published;
}

void map_to_cdr(benchmark::State& state) {
  std::vector<std::uint8_t> bytes;
  for ([[maybe_unused]] auto iteration : state) {
    dds::to_cdr(last_map(), kFrameId, bytes);
    benchmark::DoNotOptimize(bytes.data());
  }
}

void map_from_cdr(benchmark::State& state) {
  std::vector<std::uint8_t> bytes;
  dds::to_cdr(last_map(), kFrameId, bytes);
  for ([[maybe_unused]] auto iteration : state) {
    PublishedMap map;
    dds::from_cdr(bytes, kFrameId, map);
    benchmark::DoNotOptimize(map);
  }
}

void detections_from_cdr(benchmark::State& state) {
  std::vector<std::uint8_t> bytes;
  dds::to_cdr(frames().back().record.frame, kFrameId, bytes);
  for ([[maybe_unused]] auto iteration : state) {
    DetectionFrame frame;
    dds::from_cdr(bytes, kFrameId, frame);
    benchmark::DoNotOptimize(frame);
  }
}

void frame_from_json_line(benchmark::State& state) {
  const std::string line = to_json_line(frames().back().record);
  for ([[maybe_unused]] auto iteration : state) benchmark::DoNotOptimize(io::frame_from_json(line));
}

void map_to_json_line(benchmark::State& state) {
  for ([[maybe_unused]] auto iteration : state) benchmark::DoNotOptimize(io::to_json_line(last_map().map));
}

/// As a planner does with each map: from the map to the way, with the way before.
void way_of_60_m(benchmark::State& state) {
  const LocalMap& map = last_map().map;
  std::optional<Way> way;
  for ([[maybe_unused]] auto iteration : state) {
    const LaneGraph graph(map);
    way = way_ahead(graph, map.T_map_body, WayWish::straight, way ? &*way : nullptr);
    benchmark::DoNotOptimize(way);
  }
  state.counters["metres"] = way ? way->known_m : 0.0;
}

/// Each iteration is a second of traffic before the guard in front of DDS.
void guard(benchmark::State& state, std::size_t frame_bytes, std::size_t datagram_bytes) {
  const std::vector<Datagram> traffic = second_of_traffic(frame_bytes, datagram_bytes);
  dds::RtpsGuard guard;
  for ([[maybe_unused]] auto iteration : state)
    for (const Datagram& datagram : traffic)
      if (guard.check(datagram, 0)) return state.SkipWithError("the traffic is refused");
  state.counters["datagrams"] = static_cast<double>(traffic.size());
  state.counters["share_of_a_core"] =
      benchmark::Counter(1.0, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Registers the stages that updates of a method reach.
void register_stages(FusionMethod method, const std::string& method_name) {
  MapperConfig config;
  config.method = method;
  class Reached : public StageObserver {
   public:
    void update_begins() override {}
    void stage_done(Stage stage) override { stages.push_back(stage); }
    std::vector<Stage> stages;
  } reached;
  Mapper(config).update(DetectionFrame{}, Eigen::Isometry3d::Identity(), &reached);
  for (const Stage one : reached.stages)
    benchmark::RegisterBenchmark((method_name + "/" + name(one)).c_str(), stage, one, config)
        ->UseManualTime();
}

}  // namespace
}  // namespace laneloom::bench

int main(int argc, char** argv) {
  laneloom::bench::register_stages(laneloom::FusionMethod::lines, "lines");
  laneloom::bench::register_stages(laneloom::FusionMethod::voxels, "voxels");
  constexpr std::size_t kLargeFrameBytes = 12'600'000, kSmallDatagramBytes = 1400,
                        kLargeDatagramBytes = 63'000;
  benchmark::RegisterBenchmark("guard/town", laneloom::bench::guard, 10'000, kSmallDatagramBytes);
  benchmark::RegisterBenchmark("guard/12_6_MB", laneloom::bench::guard, kLargeFrameBytes,
                               kLargeDatagramBytes);
  benchmark::RegisterBenchmark("guard/12_6_MB_in_small_datagrams", laneloom::bench::guard, kLargeFrameBytes,
                               kSmallDatagramBytes);
  benchmark::RegisterBenchmark("map_to_cdr", laneloom::bench::map_to_cdr);
  benchmark::RegisterBenchmark("map_from_cdr", laneloom::bench::map_from_cdr);
  benchmark::RegisterBenchmark("detections_from_cdr", laneloom::bench::detections_from_cdr);
  benchmark::RegisterBenchmark("frame_from_json", laneloom::bench::frame_from_json_line);
  benchmark::RegisterBenchmark("map_to_json", laneloom::bench::map_to_json_line);
  benchmark::RegisterBenchmark("way_of_60_m", laneloom::bench::way_of_60_m);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
