#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "check/findings.hpp"
#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "config/config_file.hpp"
#include "config/network_profile.hpp"
#include "io/text_file.hpp"
#include "replay/message_source.hpp"
#include "replay/replay.hpp"
#include "session/sensor_offsets.hpp"

namespace laneloom::commands {
namespace {

struct LearnOptions {
  std::string in, out, config;
  bool sensor_left = false;
  bool strict = false;
};

/// Lateral offsets that the drive was mapped with stay in the profiles.
void keep_offsets(const Config& config, NetworkProfiles& networks) {
  for (const auto& [source, profile] : config::load_network_profiles(config.mapper.fusion.profile_file))
    if (const auto offset = profile.find(session::kSensorLeft);
        offset != profile.end() && networks.contains(source))
      networks[source].insert(*offset);
}

/// Adds the lateral offsets that `laneloom check` finds.
void add_offsets(const LearnOptions& options, const Config& config, NetworkProfiles& networks) {
  const auto source = replay::open_messages(options.in, config.dds.map_frame_id);
  for (const auto& [name, left_m] : check::sensor_offsets(read_inputs(*source), config.mapper))
    networks[name].insert_or_assign(session::kSensorLeft, LearnedValue{left_m, 1.0});
}

void print(const std::string& source, const NetworkProfile& profile) {
  fmt::print("\"{}\": {} values, lateral standard deviation {:.3f} m at 12 m, {:.3f} m at 36 m\n", source,
             profile.size(), profile.at("stddev_at_12_m").value, profile.at("stddev_at_36_m").value);
  if (const auto offset = profile.find(session::kSensorLeft); offset != profile.end())
    fmt::print("\"{}\": the sensor lies {:.2f} m to the left of where its points say\n", source,
               offset->second.value);
}

NetworkProfiles learned_from(const LearnOptions& options) {
  const Config config = config::resolve_config(options.config, {});
  if (!config.mapper.fusion.learn)
    throw std::runtime_error(options.config + ": mapper.fusion.learn is false: nothing would be learned");
  replay::Replay replay(config, [](const PublishedMap& /*map*/, std::int64_t /*log_time_ns*/) {});
  replay_input(options.in, config, options.strict, replay);
  NetworkProfiles networks = replay.networks();
  if (networks.empty())
    throw std::runtime_error(
        options.in +
        ": nothing was learned: no frame was fused by mapper.method lines (see laneloom replay)");
  keep_offsets(config, networks);
  if (options.sensor_left) add_offsets(options, config, networks);
  return networks;
}

void learn(const LearnOptions& options) {
  refuse_overwriting({options.in, options.config}, {options.out});
  refuse_second_reading({options.in}, options.sensor_left ? "--sensor-left" : "");
  const NetworkProfiles networks = learned_from(options);
  io::write_text(
      options.out,
      "# What laneloom learned from a drive: mapper.fusion.profile_file starts with it. A weight is "
      "how many\n"
      "# values a value is worth.\n" +
          config::dump(networks));
  for (const auto& [source, profile] : networks) print(source, profile);
}

}  // namespace

void add_learn(CLI::App& app) {
  const auto options = std::make_shared<LearnOptions>();
  CLI::App& command =
      *app.add_subcommand("learn",
                          "Learns from a recorded drive how its networks err, for a service to start with "
                          "(mapper.fusion.profile_file)");
  command.add_option("--in,drive", options->in, "Recording, or JSON lines of frames with poses")->required();
  add_text_output(command, "--out", options->out, "Profile to write (YAML)")->required();
  command.add_option("--config", options->config, "Configuration; default: the built-in values")
      ->check(CLI::ExistingFile);
  command.add_flag("--sensor-left", options->sensor_left,
                   "Also learn a constant lateral offset of the sensor, as laneloom check measures it; it "
                   "needs a drive with bends");
  add_strict(command, options->strict);
  command.callback([options] { learn(*options); });
}

}  // namespace laneloom::commands
