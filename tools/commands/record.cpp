#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/clock.hpp"
#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/inbox.hpp"
#include "commands/options.hpp"
#include "commands/stop_signal.hpp"
#include "config/config_file.hpp"
#include "laneloom/dds/cdr.hpp"
#include "laneloom/dds/raw_reader.hpp"
#include "laneloom/dds/topics.hpp"
#include "recording/log_clock.hpp"
#include "recording/recording.hpp"
#include "recording/topics.hpp"
#include "ros2/listener.hpp"
#include "scene/scene_maker.hpp"
#include "scene/scene_recording.hpp"

namespace laneloom::commands {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// The greatest stretch that is lost if the process is killed.
constexpr std::chrono::seconds kFlushPeriod{1};
constexpr double kBytesPerMB = 1e6;

struct RecordOptions {
  Config config;
  recording::RecordingOptions recording;
  std::string out;
  std::string compression = "zstd";
  double duration_s = 0.0;
  double max_size_mb = 0.0;
  bool scene = false;
};

using recording::kTopicNames;

using Counts = std::array<std::uint64_t, kTopicNames.size()>;

/// The messages that are not written yet, so that none of DDS's threads ever waits for the disk. When it is
/// full, messages are dropped and counted.
class Unwritten {
 public:
  bool empty() const { return messages_.empty(); }

  /// Sets the message's log time. A recording is read in the order of log times, which is the order of
  /// arrival.
  void push(recording::RawMessage message) {
    message.log_time_ns = clock_.next();
    if (bytes_ + message.bytes.size() > kCapacityBytes) {
      ++dropped_.at(message.topic);
      return;
    }
    bytes_ += message.bytes.size();
    messages_.push_back(std::move(message));
  }

  struct Taken {
    std::deque<recording::RawMessage> messages;
    Counts dropped;  ///< since the start, per topic
  };
  Taken take() {
    bytes_ = 0;
    return {std::exchange(messages_, {}), dropped_};
  }

 private:
  static constexpr std::size_t kCapacityBytes = 256U << 20U;
  std::deque<recording::RawMessage> messages_;
  std::size_t bytes_ = 0;
  recording::LogClock clock_{system_now_ns, steady_now_ns};
  Counts dropped_{};
};

/// Records all messages that a vehicle's participants exchange.
class Recorder {
 public:
  explicit Recorder(const RecordOptions& options)
      : writer_(options.out, options.recording),
        scene_(options.scene ? std::optional<scene::SceneMaker>(options.config.dds.map_frame_id)
                             : std::nullopt),
        participant_(options.config.dds, "laneloom record"),
        detections_(participant_, into_inbox<DetectionFrame>()),
        poses_(participant_, into_inbox<VehiclePose>()),
        maps_(participant_, into_inbox<PublishedMap>()),
        markings_(participant_, into_inbox<RoadMarkings>()),
        status_(participant_, into_inbox<ServiceStatus>()),
        objects_(participant_, into_inbox<TrackedObjects>()),
        next_turns_(participant_, into_inbox<NextTurn>()) {
    if (options.config.ros2.enabled) listen_to_nodes(options.config);
    fmt::print("Recording to {}\n", writer_.path());
    std::fflush(stdout);
  }

  /// Writes all messages that have arrived. Waits for one no longer than `patience`.
  void step(std::chrono::milliseconds patience) {
    const auto [messages, dropped] = inbox_.take(patience);
    dropped_ = dropped;
    for (const recording::RawMessage& arrival : messages) {
      writer_.write_raw(arrival);
      if (scene_) write_scene(scene_->take(arrival), arrival.log_time_ns, writer_);
      ++written_.at(arrival.topic);
    }
    if (const auto now = SteadyClock::now(); now >= next_flush_) {
      writer_.flush();
      next_flush_ = now + kFlushPeriod;
    }
  }

  /// Returns whether anything was recorded.
  bool finish() {
    nodes_.reset();
    step(std::chrono::milliseconds(0));
    writer_.close();
    for (const auto& [reason, count] : refused_.values())
      fmt::print(stderr, "laneloom: {} messages of ROS 2 were refused ({})\n", count, reason);
    for (std::size_t i = 0; i < kTopicNames.size(); ++i) {
      fmt::print("{:<26} {:>8} messages\n", kTopicNames.at(i), written_.at(i));
      if (dropped_.at(i) > 0)
        fmt::print(stderr, "laneloom: the disk was too slow: {} of {} were dropped\n", dropped_.at(i),
                   kTopicNames.at(i));
    }
    return std::ranges::any_of(written_, [](std::uint64_t count) { return count > 0; });
  }

 private:
  template <class T>
  typename dds::RawReader<T>::Callback into_inbox() {
    return [this](const dds::WriterId& /*writer*/, std::vector<std::uint8_t>&& message) {
      inbox_.put({.topic = recording::kTopicIndex<T>, .bytes = std::move(message)});
    };
  }

  /// What nodes of ROS 2 write becomes messages of laneloom's own topics.
  void listen_to_nodes(const Config& config) {
    nodes_ = std::make_unique<ros2::Listener>(
        config, "laneloom record for ROS 2",
        ros2::Inputs{.detections = as_own<DetectionFrame>(config.dds.map_frame_id),
                     .poses = as_own<VehiclePose>(config.dds.map_frame_id),
                     .objects = as_own<TrackedObjects>(config.dds.map_frame_id),
                     .next_turns = as_own<NextTurn>(config.dds.map_frame_id)});
  }
  template <class T>
  dds::ReaderCallbacks<T> as_own(const std::string& map_frame_id) {
    dds::ReaderCallbacks<T> callbacks;
    callbacks.sample = [this, map_frame_id](T&& message) {
      recording::RawMessage raw{.topic = recording::kTopicIndex<T>};
      dds::to_cdr(message, map_frame_id, raw.bytes);
      inbox_.put(std::move(raw));
    };
    callbacks.refused = [this](std::string_view reason) {
      const std::lock_guard lock(refused_mutex_);
      refused_.add(fmt::format("{}: {}", kTopicNames.at(recording::kTopicIndex<T>), reason));
    };
    return callbacks;
  }

  recording::RecordingWriter writer_;
  std::optional<scene::SceneMaker> scene_;
  Inbox<recording::RawMessage, Unwritten> inbox_;
  Counts written_{}, dropped_{};
  SteadyClock::time_point next_flush_ = SteadyClock::now() + kFlushPeriod;
  dds::Participant participant_;
  // They end before the inbox that they fill.
  dds::RawReader<DetectionFrame> detections_;
  dds::RawReader<VehiclePose> poses_;
  dds::RawReader<PublishedMap> maps_;
  dds::RawReader<RoadMarkings> markings_;
  dds::RawReader<ServiceStatus> status_;
  dds::RawReader<TrackedObjects> objects_;
  dds::RawReader<NextTurn> next_turns_;
  std::mutex refused_mutex_;
  Counters refused_;                       ///< messages of nodes of ROS 2
  std::unique_ptr<ros2::Listener> nodes_;  ///< null: ros2 is not enabled
};

std::string default_name() {
  return fmt::format("laneloom_{:%Y%m%d_%H%M%S}", fmt::gmtime(std::time(nullptr)));
}

void record(RecordOptions options) {
  catch_stop_signals();
  if (options.out.empty()) options.out = default_name();
  if (std::filesystem::is_directory(options.out)) options.out += "/" + default_name();
  options.recording.compression = kCompressions.at(options.compression);
  options.recording.max_file_bytes = static_cast<std::uint64_t>(options.max_size_mb * kBytesPerMB);
  if (options.scene) options.recording.extra_topics = scene::scene_topics();

  Recorder recorder(options);
  const auto start = SteadyClock::now();
  const auto is_over = [&] {
    const std::chrono::duration<double> elapsed = SteadyClock::now() - start;
    return options.duration_s > 0.0 && elapsed.count() >= options.duration_s;
  };
  while (!stop_requested() && !is_over()) recorder.step(std::chrono::milliseconds(50));
  if (recorder.finish()) return;
  fmt::print(stderr, "laneloom: nobody was heard in domain {} as vehicle \"{}\": see laneloom doctor\n",
             options.config.dds.domain, options.config.dds.vehicle_id);
  end_with(kNobodyHeard);
}

}  // namespace

void add_record(CLI::App& app) {
  CLI::App* command = app.add_subcommand("record", "Records all topics of a vehicle into MCAP files");
  const auto options = std::make_shared<RecordOptions>();
  command
      ->add_option_function<std::string>(
          "--config", [options](const std::string& file) { options->config = config::load_config(file); },
          "Configuration of the service: its section dds says where to listen, and with ros2.enabled what "
          "nodes of ROS 2 write is recorded as well")
      ->trigger_on_parse();
  add_dds(*command, options->config.dds);
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
      ->add_option("--map-frame-id", options->config.dds.map_frame_id,
                   "With --scene: frame of the poses; default: map")
      ->needs(scene);
  command->callback([options] { record(*options); });
}

}  // namespace laneloom::commands
