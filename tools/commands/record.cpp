#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <ctime>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "commands/stop_signal.hpp"
#include "laneloom/dds/raw_reader.hpp"
#include "laneloom/dds/topics.hpp"
#include "recording/recording.hpp"
#include "scene/scene_maker.hpp"
#include "scene/scene_recording.hpp"

namespace laneloom {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// The greatest stretch that is lost if the process is killed.
constexpr std::chrono::seconds kFlushPeriod{1};
constexpr std::size_t kInboxBytes = 256U << 20U;
constexpr double kBytesPerMB = 1e6;

struct Options {
  DdsConfig dds;
  RecordingOptions recording;
  std::string out;
  std::string compression = "zstd";
  double duration_s = 0.0;
  double max_size_mb = 0.0;
  bool scene = false;
};

/// The topics in the order of AnyMessage.
constexpr std::array kTopics{dds::kDetectionsTopic, dds::kVehiclePoseTopic, dds::kLaneMapTopic,
                             dds::kRoadMarkingsTopic, dds::kStatusTopic};

/// Passes messages from DDS's threads to ours, so that none of them ever waits for the disk. When it is full,
/// messages are dropped and counted.
class Inbox {
 public:
  void put(std::size_t topic, std::vector<std::uint8_t>&& message) {
    const std::lock_guard lock(mutex_);
    const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
    // A recording is read in the order of log times. It stays the order of arrival even if the clock is set
    // back.
    log_time_ns_ = std::max(log_time_ns_ + 1, std::int64_t{now.count()});
    if (bytes_ + message.size() > kInboxBytes) {
      ++dropped_[topic];
      return;
    }
    bytes_ += message.size();
    arrivals_.push_back({log_time_ns_, topic, std::move(message)});
    arrived_.notify_one();
  }

  /// Takes all messages that have arrived. Waits for one no longer than `patience`.
  std::deque<RawMessage> take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, patience, [&] { return !arrivals_.empty(); });
    bytes_ = 0;
    return std::exchange(arrivals_, {});
  }

  std::array<std::uint64_t, kTopics.size()> dropped() {
    const std::lock_guard lock(mutex_);
    return dropped_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<RawMessage> arrivals_;
  std::size_t bytes_ = 0;
  std::int64_t log_time_ns_ = 0;
  std::array<std::uint64_t, kTopics.size()> dropped_{};
};

/// Records all messages that a vehicle's participants exchange.
class Recorder {
 public:
  explicit Recorder(const Options& options)
      : writer_(options.out, options.recording),
        scene_(options.scene ? std::optional<SceneMaker>(options.dds.map_frame_id) : std::nullopt),
        participant_(options.dds, "laneloom record"),
        detections_(participant_, into_inbox(0)),
        poses_(participant_, into_inbox(1)),
        maps_(participant_, into_inbox(2)),
        markings_(participant_, into_inbox(3)),
        status_(participant_, into_inbox(4)) {
    fmt::print("Recording to {}\n", writer_.path());
    std::fflush(stdout);
  }

  /// Writes all messages that have arrived. Waits for one no longer than `patience`.
  void step(std::chrono::milliseconds patience) {
    for (const RawMessage& arrival : inbox_.take(patience)) {
      writer_.write_raw(arrival);
      if (scene_) write_scene(scene_->take(arrival), arrival.log_time_ns, writer_);
      ++written_.at(arrival.topic);
    }
    if (const auto now = SteadyClock::now(); now >= next_flush_) {
      writer_.flush();
      next_flush_ = now + kFlushPeriod;
    }
  }

  void finish() {
    step(std::chrono::milliseconds(0));
    writer_.close();
    const auto dropped = inbox_.dropped();
    for (std::size_t i = 0; i < kTopics.size(); ++i) {
      fmt::print("{:<26} {:>8} messages\n", kTopics.at(i), written_.at(i));
      if (dropped.at(i) > 0)
        fmt::print(stderr, "laneloom: the disk was too slow: {} of {} were dropped\n", dropped.at(i),
                   kTopics.at(i));
    }
  }

 private:
  dds::RawReader<DetectionFrame>::Callback into_inbox(std::size_t topic) {
    return [this, topic](const dds::WriterId& /*writer*/, std::vector<std::uint8_t>&& message) {
      inbox_.put(topic, std::move(message));
    };
  }

  RecordingWriter writer_;
  std::optional<SceneMaker> scene_;
  Inbox inbox_;
  std::array<std::uint64_t, kTopics.size()> written_{};
  SteadyClock::time_point next_flush_ = SteadyClock::now() + kFlushPeriod;
  dds::Participant participant_;
  // In the order of kTopics. They end before the inbox that they fill.
  dds::RawReader<DetectionFrame> detections_;
  dds::RawReader<VehiclePose> poses_;
  dds::RawReader<PublishedMap> maps_;
  dds::RawReader<RoadMarkings> markings_;
  dds::RawReader<ServiceStatus> status_;
};

std::string default_name() {
  return fmt::format("laneloom_{:%Y%m%d_%H%M%S}", fmt::gmtime(std::time(nullptr)));
}

void record(Options options) {
  catch_stop_signals();
  if (options.out.empty()) options.out = default_name();
  if (std::filesystem::is_directory(options.out)) options.out += "/" + default_name();
  options.recording.compression = kCompressions.at(options.compression);
  options.recording.max_file_bytes = static_cast<std::uint64_t>(options.max_size_mb * kBytesPerMB);
  if (options.scene) options.recording.extra_topics = scene_topics();

  Recorder recorder(options);
  const auto start = SteadyClock::now();
  const auto is_over = [&] {
    const std::chrono::duration<double> elapsed = SteadyClock::now() - start;
    return options.duration_s > 0.0 && elapsed.count() >= options.duration_s;
  };
  while (!stop_requested() && !is_over()) recorder.step(std::chrono::milliseconds(50));
  recorder.finish();
}

}  // namespace

void add_record(CLI::App& app) {
  CLI::App* command = app.add_subcommand("record", "Records all topics of a vehicle into MCAP files");
  const auto options = std::make_shared<Options>();
  add_dds(*command, options->dds);
  command->add_option("--out", options->out,
                      "File (.mcap), or a folder; default: laneloom_<UTC time>.mcap here");
  add_compression(*command, options->compression);
  command->add_option("--max-size", options->max_size_mb, "Size in MB after which a new file is begun")
      ->check(within(1e-3, 1e9));
  command
      ->add_option("--max-duration", options->recording.max_file_s, "Seconds after which a new file is begun")
      ->check(positive_seconds());
  command->add_option("--duration", options->duration_s, "Seconds; default: until it is stopped")
      ->check(positive_seconds());
  CLI::Option* scene = command->add_flag(
      "--scene", options->scene, "Add /laneloom/scene and /tf, for the 3D panels of Foxglove and Lichtblick");
  command
      ->add_option("--map-frame-id", options->dds.map_frame_id,
                   "With --scene: frame of the poses; default: map")
      ->needs(scene);
  command->callback([options] { record(*options); });
}

}  // namespace laneloom
