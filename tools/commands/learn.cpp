#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "config/config_file.hpp"
#include "config/network_profile.hpp"
#include "io/text_file.hpp"
#include "replay/replay.hpp"

namespace laneloom::commands {
namespace {

struct LearnOptions {
  std::string in, out, config;
  bool strict = false;
};

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
  return networks;
}

void learn(const LearnOptions& options) {
  const NetworkProfiles networks = learned_from(options);
  io::write_text(
      options.out,
      "# What laneloom learned from a drive: mapper.fusion.profile_file starts with it. A weight is "
      "how many\n"
      "# values a value is worth.\n" +
          config::dump(networks));
  for (const auto& [source, profile] : networks)
    fmt::print("\"{}\": {} values, lateral standard deviation {:.3f} m at 12 m, {:.3f} m at 36 m\n", source,
               profile.size(), profile.at("stddev_at_12_m").value, profile.at("stddev_at_36_m").value);
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
  add_strict(command, options->strict);
  command.callback([options] { learn(*options); });
}

}  // namespace laneloom::commands
