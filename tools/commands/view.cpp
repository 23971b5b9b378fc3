#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>

#include "commands/commands.hpp"
#include "commands/inbox.hpp"
#include "commands/options.hpp"
#include "commands/recorded_view.hpp"
#include "commands/stop_signal.hpp"
#include "laneloom/dds/reader.hpp"
#include "support/system_clock.hpp"
#include "view/door.hpp"
#include "view/frame_text.hpp"
#include "view/site.hpp"

namespace laneloom {
namespace {

constexpr std::chrono::milliseconds kLook{200};  // between looks at whether a recording can be read

struct Options {
  DdsConfig dds;
  WebServerConfig server{.port = 8642};
  RecordedInputs recorded;
  RangeConfig range;
};

/// Whether a writer of maps asserts its liveliness.
struct Alive {
  bool alive = false;
};

/// A message, and when it arrived (system clock).
struct Arrival {
  std::variant<DetectionFrame, VehiclePose, PublishedMap, RoadMarkings, ServiceStatus, Alive> what;
  std::int64_t time_ns = 0;
};

/// Shows what a vehicle's participants say to each other now.
class LiveView {
 public:
  explicit LiveView(const Options& options) : options_(options), participant_(options.dds, "laneloom view") {}

  /// Publishes frames until the program is to end.
  void run(Site& site, WebServer& server) {
    while (!stop_requested()) {
      auto arrival = inbox_.take(std::chrono::milliseconds(50));
      if (!arrival) continue;
      if (const auto* status = std::get_if<ServiceStatus>(&arrival->what)) site.set_status(*status);
      if (const auto* alive = std::get_if<Alive>(&arrival->what)) {
        set_alive(alive->alive);
      } else {
        if (!add(std::move(*arrival))) continue;
        shown_ = builder_.take();
        shown_->alive = alive_;
      }
      if (shown_) show(server);
    }
  }

 private:
  bool add(Arrival&& arrival) {
    return std::visit(
        [&](auto&& message) {
          if constexpr (std::is_same_v<std::decay_t<decltype(message)>, Alive>)
            return false;
          else
            return builder_.add(std::forward<decltype(message)>(message), arrival.time_ns);
        },
        std::move(arrival.what));
  }

  /// The last moment is shown once more, as it tells.
  void set_alive(bool alive) {
    alive_ = alive;
    if (!shown_) return;
    shown_->alive = alive;
    shown_->map.map.lineage.clear();
  }

  void show(WebServer& server) {
    const FramePlace place{number_++, events_.next(*shown_)};
    server.publish(frame_text(*shown_, place, options_.range));
  }

  template <class T>
  dds::ReaderCallbacks<T> into_inbox() {
    return {.sample = [this](T&& message) { inbox_.put({std::move(message), system_now_ns()}); }};
  }
  dds::ReaderCallbacks<PublishedMap> maps_into_inbox() {
    auto callbacks = into_inbox<PublishedMap>();
    callbacks.alive = [this](int writers) { inbox_.put({Alive{writers > 0}, system_now_ns()}); };
    return callbacks;
  }

  const Options& options_;
  Inbox<Arrival> inbox_;
  MomentBuilder builder_;
  EventFinder events_;
  std::optional<ViewMoment> shown_;
  bool alive_ = true;
  std::uint64_t number_ = 0;
  // They end before the inbox that they fill.
  dds::Participant participant_;
  dds::Reader<DetectionFrame> detections_{participant_, into_inbox<DetectionFrame>()};
  dds::Reader<VehiclePose> poses_{participant_, into_inbox<VehiclePose>()};
  dds::Reader<PublishedMap> maps_{participant_, maps_into_inbox()};
  dds::Reader<RoadMarkings> markings_{participant_, into_inbox<RoadMarkings>()};
  dds::Reader<ServiceStatus> statuses_{participant_, into_inbox<ServiceStatus>()};
};

/// For a browser; on every address, this host's own name stands for it.
void print_url(const WebServerConfig& config, std::uint16_t port) {
  std::string host = config.address;
  if (host == "0.0.0.0" || host == "::") host = "localhost";
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  fmt::print("http://{}:{}/{}\n", host, port, config.token.empty() ? "" : "?token=" + config.token);
  std::fflush(stdout);
}

void view_live(const Options& options) {
  Site site(fmt::format("vehicle {}, domain {}", options.dds.vehicle_id, options.dds.domain), "[]", nullptr);
  LiveView view(options);
  WebServer server(options.server, [&site](std::string_view target) { return site.answer(target); });
  print_url(options.server, server.port());
  view.run(site, server);
}

void view_recording(const Options& options) {
  FrameStore store;
  const Site site(options.recorded.title(), truth_elements(options.recorded), &store,
                  options.recorded.names());
  std::thread loader([&] { load(options.recorded, options.range, store); });
  try {
    const WebServer server(options.server, [&site](std::string_view target) { return site.answer(target); });
    print_url(options.server, server.port());
    while (store.failure().empty() && sleep_until(std::chrono::steady_clock::now() + kLook)) {
    }
  } catch (...) {
    loader.join();
    throw;
  }
  loader.join();
  if (const std::string failure = store.failure(); !failure.empty()) throw std::runtime_error(failure);
}

void view(Options options) {
  catch_stop_signals();
  if (!is_loopback(options.server.address)) options.server.token = random_token();
  options.recorded.empty() ? view_live(options) : view_recording(options);
}

}  // namespace

void add_view(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("view", "Shows the live map, or a recording, in a browser: prints the URL");
  const auto options = std::make_shared<Options>();
  add_dds(*command, options->dds);
  command->add_option("--port", options->server.port, "Of the web server; 0: one that is free")
      ->capture_default_str();
  command
      ->add_option("--listen", options->server.address,
                   "Address to listen on; other hosts reach it only with the token that is printed")
      ->capture_default_str();
  CLI::Option* in = command->add_option("--in", options->recorded.recording, "Recording to show (.mcap)");
  command->add_option("--frames", options->recorded.frames, "Detections to show (.frames.jsonl or .mcap)")
      ->excludes(in);
  command
      ->add_option("--map", options->recorded.maps,
                   "Maps to show (.jsonl or .mcap); several of one drive are compared")
      ->excludes(in);
  command
      ->add_option("--config", options->recorded.configs,
                   "Map the detections of --in (.mcap or .frames.jsonl) anew by this configuration (.yaml); "
                   "several are compared")
      ->needs(in);
  command->add_option("--truth", options->recorded.truth, "Truth of the road to show (.json)");
  add_range(*command, options->range);
  command->callback([options] { view(*options); });
}

}  // namespace laneloom
