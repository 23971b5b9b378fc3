#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <thread>
#include <utility>

#include "commands/commands.hpp"
#include "commands/live_view.hpp"
#include "commands/options.hpp"
#include "commands/recorded_view.hpp"
#include "commands/stop_signal.hpp"
#include "view/door.hpp"
#include "view/file_desk.hpp"

namespace laneloom::commands {
namespace {

constexpr std::size_t kMaxFileBytes = 256U << 20U;  // of a file that is dropped onto the page
constexpr std::chrono::milliseconds kLook{200};     // between looks at whether a recording can be read

struct ViewOptions {
  DdsConfig dds;
  view::WebServerConfig server{.port = 8642};
  RecordedInputs recorded;
  RangeConfig range;
  bool foxglove = false;
};

/// Prints the URLs. If the server listens on all addresses, "localhost" stands for them.
void print_urls(const ViewOptions& options, std::uint16_t port) {
  std::string host = options.server.address;
  if (host == "0.0.0.0" || host == "::") host = "localhost";
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  const std::string token = options.server.token.empty() ? "" : "?token=" + options.server.token;
  fmt::print("http://{}:{}/{}\n", host, port, token);
  if (options.foxglove) fmt::print("ws://{}:{}/{}\n", host, port, token);
  std::fflush(stdout);
}

/// Reads a file that a page put.
view::FileDesk::Loader file_loader(const RangeConfig& range) {
  return [range](const std::filesystem::path& file, view::FrameStore& store, const std::stop_token& stop) {
    load({.recording = file.string(), .name = file.filename().string()}, range, nullptr, store, stop);
  };
}

view::WebServer serve(const ViewOptions& options, view::FileDesk& desk) {
  return {options.server, [&desk](std::string_view target) { return desk.answer(target); },
          [&desk](std::string_view target, io::WorkFolder folder) {
            return desk.open(target, std::move(folder));
          }};
}

void view_live(const ViewOptions& options) {
  LiveView view(options.dds, options.range);
  view::Site site({.title = fmt::format("vehicle {}, domain {}", options.dds.vehicle_id, options.dds.domain),
                   .max_file_bytes = options.server.max_file_bytes,
                   .black_box = &view.black_box()},
                  view.frames());
  view::FileDesk desk(site, file_loader(options.range), options.server.max_file_bytes);
  view::WebServer server = serve(options, desk);
  print_urls(options, server.port());
  view.run(site, server, options.foxglove);
}

void view_recording(const ViewOptions& options) {
  std::optional<simulation::Road> truth;
  if (!options.recorded.truth.empty()) truth = simulation::load_truth(options.recorded.truth);
  const simulation::Road* road = truth ? &*truth : nullptr;
  view::FrameStore store;
  const view::Site site({.title = options.recorded.title(),
                         .truth = truth_elements(road),
                         .names = options.recorded.names(),
                         .max_file_bytes = options.server.max_file_bytes},
                        store);
  view::FileDesk desk(site, file_loader(options.range), options.server.max_file_bytes);
  const view::WebServer server = serve(options, desk);  // before a long drive is read for nothing
  print_urls(options, server.port());
  {
    const std::jthread loader(
        [&](const std::stop_token& stop) { load(options.recorded, options.range, road, store, stop); });
    while (store.failure().empty() && sleep_until(std::chrono::steady_clock::now() + kLook)) {
    }
  }
  if (const std::string failure = store.failure(); !failure.empty()) throw std::runtime_error(failure);
}

void view(ViewOptions options) {
  catch_stop_signals();
  if (view::is_loopback(options.server.address))
    options.server.max_file_bytes = kMaxFileBytes;
  else
    options.server.token = view::random_token();
  if (options.foxglove) options.server.foxglove_topics = scene::scene_topics();
  options.recorded.empty() ? view_live(options) : view_recording(options);
}

}  // namespace

void add_view(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("view", "Shows the live map, or a recording, in a browser: prints the URL");
  const auto options = std::make_shared<ViewOptions>();
  add_dds(*command, options->dds);
  command->add_option("--port", options->server.port, "Port of the web server; 0: a free one")
      ->capture_default_str();
  command
      ->add_option("--listen", options->server.address,
                   "Address to listen on; other hosts reach it only with the token that is printed")
      ->capture_default_str();
  CLI::Option* foxglove = command->add_flag(
      "--foxglove", options->foxglove,
      "Also speak Foxglove's WebSocket protocol, for its 3D panel and Lichtblick's: prints that URL next");
  command
      ->add_option("--allow-origin", options->server.foxglove_origins,
                   "Page that may connect so, as https://app.foxglove.dev; once for each")
      ->needs(foxglove);
  command->add_option("--map-frame-id", options->dds.map_frame_id, "Live: frame of the poses")
      ->capture_default_str();
  CLI::Option* in =
      command->add_option("--in,drive", options->recorded.recording,
                          "Drive to show: a recording (.mcap), or frames to map (.frames.jsonl)");
  CLI::Option* frames =
      command->add_option("--frames", options->recorded.frames, "Detections to show (.frames.jsonl or .mcap)")
          ->excludes(in);
  CLI::Option* map = command
                         ->add_option("--map", options->recorded.maps,
                                      "Maps to show (.jsonl or .mcap); several of one drive are compared")
                         ->excludes(in);
  command
      ->add_option("--config", options->recorded.configs,
                   "Map the detections of --in (.mcap or .frames.jsonl) anew by this configuration (.yaml); "
                   "several are compared")
      ->needs(in);
  for (CLI::Option* recorded : {in, frames, map})
    foxglove->excludes(recorded);  // Foxglove opens recordings itself
  command->add_option("--truth", options->recorded.truth, "Truth of the road to show (.json)");
  add_range(*command, options->range);
  add_strict(*command, options->recorded.strict);
  command->callback([options] { view(*options); });
}

}  // namespace laneloom::commands
