#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "base/clock.hpp"
#include "base/random_id.hpp"
#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/road_source.hpp"
#include "commands/stop_signal.hpp"
#include "io/json_lines.hpp"
#include "laneloom/dds/writer.hpp"
#include "simulation/network_delay.hpp"
#include "simulation/noise_profile.hpp"
#include "simulation/scenarios.hpp"
#include "support/publication_log.hpp"

namespace laneloom::commands {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::int64_t kPosePeriod_ns = 10'000'000;
constexpr std::int64_t kPosesPerFrame = 10;

struct PublishOptions {
  RoadSource source;
  DdsConfig dds;
  double speed_up = 1.0;
  double from_s = 0.0;
  double duration_s = 0.0;
  bool loop = false;
  int readers = 0;
  double delay_spread_ms = 100.0;
  std::string truth, frames, times;
};

/// A perception and localisation stack on a simulated drive. Its sensor clock starts with the system clock
/// and then runs with the simulation.
class Publisher {
 public:
  Publisher(const PublishOptions& options, const simulation::Road& road)
      : participant_(options.dds, "laneloom publish"),
        detections_(participant_),
        poses_(participant_),
        road_(road),
        from_s_(options.from_s),
        perception_(options.source.perception(road)),
        tracker_(options.source.tracker(road)),
        network_(options.source.seed, options.delay_spread_ms),
        session_id_(random_id()),
        start_ns_(system_now_ns()) {
    if (tracker_) objects_.emplace(participant_);
    if (!options.frames.empty()) record_ = std::make_unique<io::JsonLinesWriter>(options.frames);
    if (!options.times.empty())
      times_ = std::make_unique<support::PublicationLogWriter>(options.times, session_id_);
  }

  /// Number of readers, of the topic that has fewer.
  int readers() const { return std::min(detections_.matched(), poses_.matched()); }

  /// Publishes the messages that are due at the simulation's time of pose number `step`.
  void step(std::int64_t step) {
    const std::int64_t now_ns = step * kPosePeriod_ns;
    const VehiclePose pose = pose_at(step);
    if (!poses_.write(pose)) ++not_taken_;
    if (step % kPosesPerFrame == 0) network_.put(observe(pose, drive_s(step)), now_ns);
    while (const std::optional<io::FrameRecord> record = network_.take(now_ns)) deliver(*record);
  }

  void finish() {
    if (record_) record_->close();
    if (times_) times_->close();
    fmt::print("{} frames published", delivered_);
    if (not_taken_ > 0) fmt::print(", {} messages not taken by DDS", not_taken_);
    fmt::print("\n");
  }

 private:
  /// Seconds since the drive's start.
  double drive_s(std::int64_t step) const {
    const double t_s = from_s_ + static_cast<double>(step) * static_cast<double>(kPosePeriod_ns) * 1e-9;
    return std::fmod(t_s, road_.drive.duration_s());
  }
  VehiclePose pose_at(std::int64_t step) const {
    VehiclePose pose = road_.drive.pose_at(drive_s(step));
    pose.stamp_ns = start_ns_ + step * kPosePeriod_ns;
    pose.sequence = static_cast<std::uint64_t>(step);
    pose.session_id = session_id_;
    return pose;
  }

  io::FrameRecord observe(const VehiclePose& pose, double drive_s) {
    io::FrameRecord record{perception_.observe(pose), pose};
    record.frame.session_id = session_id_;
    record.frame.source = "laneloom publish";
    if (tracker_) {
      record.objects = tracker_(pose, drive_s);
      record.objects->session_id = session_id_;
    }
    return record;
  }

  void deliver(const io::FrameRecord& record) {
    if (times_) times_->add(record.frame.sequence, system_now_ns());
    if (!detections_.write(record.frame)) ++not_taken_;
    if (record.objects && !objects_->write(*record.objects)) ++not_taken_;
    if (record_) record_->write(record);
    ++delivered_;
  }

  dds::Participant participant_;
  dds::Writer<DetectionFrame> detections_;
  dds::Writer<VehiclePose> poses_;
  std::optional<dds::Writer<TrackedObjects>> objects_;  ///< where there is traffic
  const simulation::Road& road_;
  double from_s_;
  simulation::Perception perception_;
  Tracker tracker_;
  simulation::NetworkDelay<io::FrameRecord> network_;
  std::uint64_t session_id_;
  std::int64_t start_ns_;
  std::unique_ptr<io::JsonLinesWriter> record_;
  std::unique_ptr<support::PublicationLogWriter> times_;
  std::uint64_t delivered_ = 0;
  std::uint64_t not_taken_ = 0;
};

std::int64_t step_count(const PublishOptions& options, const simulation::Road& road) {
  constexpr double kPosesPerSecond = 1e9 / static_cast<double>(kPosePeriod_ns);
  if (options.duration_s > 0.0) return std::llround(options.duration_s * kPosesPerSecond);
  if (options.loop) return std::numeric_limits<std::int64_t>::max();
  return std::llround(std::floor((road.drive.duration_s() - options.from_s) * kPosesPerSecond));
}

void publish(const PublishOptions& options) {
  refuse_overwriting({options.source.lanelet2, options.source.opendrive},
                     {options.truth, options.frames, options.times});
  catch_stop_signals();
  const simulation::Road road = options.source.load();
  const double drive_s = road.drive.duration_s();
  if (options.from_s >= drive_s)
    throw std::runtime_error(fmt::format("the drive lasts {:.1f} s; begin earlier", drive_s));
  if (!options.loop && options.from_s + options.duration_s > drive_s)
    throw std::runtime_error(fmt::format("the drive lasts {:.1f} s; drive on with --loop", drive_s));
  if (!options.truth.empty()) save_truth(options.truth, road);
  Publisher publisher(options, road);
  while (publisher.readers() < options.readers)
    if (!sleep_until(SteadyClock::now() + std::chrono::milliseconds(20))) return publisher.finish();
  if (options.readers > 0 && !sleep_until(SteadyClock::now() + kDiscovery)) return publisher.finish();

  const SteadyClock::time_point start = SteadyClock::now();
  const std::int64_t steps = step_count(options, road);
  for (std::int64_t step = 0; step < steps; ++step) {
    const double due_ns = static_cast<double>(step * kPosePeriod_ns) / options.speed_up;
    if (!sleep_until(start + std::chrono::nanoseconds(std::llround(due_ns)))) break;
    publisher.step(step);
  }
  std::this_thread::sleep_for(kDelivery);
  publisher.finish();
}

void list() {
  fmt::print("Built-in roads: {}\nNoise: {}, random:SEED\n", fmt::join(simulation::scenario_names(), ", "),
             fmt::join(simulation::noise_profile_names(), ", "));
  throw CLI::Success();
}

}  // namespace

void add_publish(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("publish", "Test publisher: drives over a known road and publishes what is seen");
  const auto options = std::make_shared<PublishOptions>();
  add_road_source(*command, options->source);
  add_dds(*command, options->dds);
  command->add_option("--speed-up", options->speed_up, "Simulated seconds per second")
      ->check(within(0.01, 100.0))
      ->capture_default_str();
  command->add_flag("--loop", options->loop,
                    "Drive on for ever; where the drive does not end as it began, the pose jumps");
  command->add_option("--from", options->from_s, "Time to begin at, in seconds of the drive")
      ->check(within(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--duration", options->duration_s, "Simulated seconds; default: the drive once")
      ->check(positive_seconds());
  command
      ->add_option("--wait-for-readers", options->readers,
                   "Number of readers of detections and of poses to wait for")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--delay-spread", options->delay_spread_ms,
                   "Milliseconds from the shortest to the longest delay of a frame; the mean is 100")
      ->check(within(0.0, 100.0))
      ->capture_default_str();
  add_text_output(*command, "--truth", options->truth, "Truth of the road to write (.json)");
  add_text_output(*command, "--frames", options->frames,
                  "Detections and exact poses to write (.frames.jsonl)");
  command->add_option("--times", options->times, "Times of each frame's publication to write (.csv)");
  command->add_flag_callback("--list", list, "List the built-in roads and kinds of noise")
      ->trigger_on_parse();
  command->callback([options] { publish(*options); });
}

}  // namespace laneloom::commands
