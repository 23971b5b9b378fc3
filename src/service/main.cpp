#include <spdlog/spdlog.h>
#include <sysexits.h>
#include <systemd/sd-daemon.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "base/clock.hpp"
#include "base/file_stamp.hpp"
#include "base/random_id.hpp"
#include "config/config_file.hpp"
#include "laneloom/dds/participant.hpp"
#include "sd_map/osm.hpp"
#include "service/endpoints.hpp"
#include "service/executor.hpp"
#include "service/ingestion_queue.hpp"
#include "service/log.hpp"
#include "service/service.hpp"
#include "service/signals.hpp"
#include "session/mapping_session.hpp"
#include "snapshot/snapshot_file.hpp"

namespace laneloom::service {
namespace {

struct Options {
  std::string config_file;
  std::string preset;
  std::optional<std::string> vehicle_id;
  std::optional<int> domain;
  std::optional<std::string> snapshot_file;
  bool check_only = false;
  bool dump_only = false;
};

/// The configuration of the file, overridden by the preset, overridden by the other options of the command
/// line.
Config configure(const Options& options) {
  Config config = config::resolve_config(options.config_file, options.preset);
  if (options.vehicle_id) config.dds.vehicle_id = *options.vehicle_id;
  if (options.domain) config.dds.domain = *options.domain;
  if (options.snapshot_file) config.service.snapshot_file = *options.snapshot_file;
  config::validate(config);
  return config;
}

/// The contents of files, or their size and time, by the key that names each. Other ones tell of a change.
using Contents = std::map<std::string, std::string>;

/// The configuration that the service runs with.
struct Running {
  Config config;
  Contents files;  ///< of the files that are read once, at the start
};

/// The text of a file. Empty: there is none.
std::string text_of(const std::string& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return {};
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return std::move(text).str();
}

Contents contents_of(const Config& config) {
  return {{"dds.profile_file", text_of(config.dds.profile_file)},
          {"mapper.fusion.profile_file", text_of(config.mapper.fusion.profile_file)},
          {"sd_map.file", file_stamp(config.sd_map.file)}};
}

/// Throws ConfigError for a file that the next start would refuse. An SD map is not read: that may take
/// seconds. Nor is a profile of DDS: Fast DDS refuses a second one of the same name in one process.
void check_named_files(Config config) {
  dds::check_profile_file(config.dds);
  config.dds.profile_file.clear();
  dds::check_files(config.dds);
  sd_map::check_sd_map_file(config.sd_map);
  config.sd_map = {};
  const session::MappingSession session(config);
}

/// Applies the settings that can change while the service runs, and logs which can not.
void reconfigure(Running& running, const Options& options) try {
  const auto wanted = configure(options);
  check_named_files(wanted);
  auto& config = running.config;
  for (const auto& key : config::changed_keys(config, wanted)) {
    if (key == "service.log_level") {
      config.service.log_level = wanted.service.log_level;
      set_log_level(config.service.log_level);
      spdlog::info("event=changed key={} value={}", key, config.service.log_level);
    } else {
      spdlog::warn("event=needs_restart key={}", key);
    }
  }
  for (const auto& [key, content] : contents_of(config))
    if (content != running.files.at(key))
      spdlog::warn("event=needs_restart key={} why=\"its content changed\"", key);
} catch (const ConfigError& error) {
  spdlog::error("event=configuration_refused reason=\"{}\"", error.what());
}

/// Makes the endpoints anew: after a change of the network, only new endpoints see interfaces that were down.
void reopen(Service& service) try {
  service.check_reopening();
  sd_notify(0, "WATCHDOG=1");
  service.reopen();
  spdlog::info("event=reopened");
} catch (const ConfigError& error) {
  spdlog::error("event=reopening_refused reason=\"{}\"", error.what());
}

/// No tick comes meanwhile. Each of the steps may take a second on a busy host, and the watchdog ends what
/// says nothing for two.
void reload(Service& service, Running& running, const Options& options) {
  sd_notifyf(0, "RELOADING=1\nMONOTONIC_USEC=%lld", static_cast<long long>(steady_now_ns() / 1000));
  reconfigure(running, options);
  sd_notify(0, "WATCHDOG=1");
  reopen(service);
  sd_notify(0, "READY=1");
}

/// Ends the process so that it is started again. Nothing is destroyed, which could wait for a thread that
/// hangs.
[[noreturn]] void end_deaf() {
  spdlog::critical("event=deaf why=\"DDS does not take what it receives\"");
  std::_Exit(EXIT_FAILURE);
}

void run(const Config& config, const Options& options) {
  Signals signals;
  Running running{config, contents_of(config)};
  Service service(config, steady_now_ns, [&signals] { signals.call(); });
  spdlog::info("event=started version={} config={} domain={} vehicle={}", core::version(),
               config::config_hash(config), config.dds.domain, config.dds.vehicle_id);

  bool ready = false;
  const auto tick = [&](const core::Tick& now) {
    service.tick(now);
    if (service.is_deaf()) end_deaf();
    if (!ready) sd_notify(0, "READY=1");
    ready = true;
    sd_notifyf(0, "WATCHDOG=1\nSTATUS=%s", service.summary().c_str());
  };
  const auto sleep_until = [&](std::int64_t deadline_ns) {
    auto wake = signals.sleep_until(deadline_ns);
    for (; wake == Wake::reload; wake = signals.sleep_until(deadline_ns)) reload(service, running, options);
    return wake != Wake::stop;
  };
  const auto period_ns = static_cast<std::int64_t>(1e9 / config.service.tick_rate_hz);
  run_periodically(period_ns, {steady_now_ns, sleep_until, [&service] { return service.take_ready(); }},
                   tick);

  sd_notify(0, "STOPPING=1");
  spdlog::info("event=stopping");
}

/// Throws if standard output does not take the text.
void print(const std::string& text) {
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw std::system_error(errno, std::generic_category(), "standard output");
}

/// Throws dds::NotPermitted where DDS does not believe the identity, or it does not permit a service's work.
void check_identity(const Config& config) {
  IngestionQueue queue(config);
  const Endpoints trial(config, random_id(), queue, steady_now_ns, dds::Participant::Presence::hidden);
}

int start(const Options& options) {
  const Config config = configure(options);
  if (options.dump_only) {
    print(config::dump(config));
    return EX_OK;
  }
  if (options.check_only) {
    const session::MappingSession session(config);  // checks the files that the configuration names
    dds::check_files(config.dds);
    if (!config.service.snapshot_file.empty()) snapshot::check_snapshot_file(config.service.snapshot_file);
    if (!config.dds.security_directory.empty()) check_identity(config);
    print("configuration " + config::config_hash(config) + " is valid\n");
    return EX_OK;
  }
  set_up_log(config.service.log_level);
  run(config, options);
  return EX_OK;
}

}  // namespace
}  // namespace laneloom::service

int main(int argc, char** argv) try {
  laneloom::service::Options options;
  CLI::App app("Fuses road-marking detections into a local lane map, over DDS.", "laneloomd");
  app.add_option("--config", options.config_file,
                 "Configuration file (YAML); keys that it lacks have their defaults");
  app.add_option("--preset", options.preset, "Range and alpha_n of the paper's data sets: inhouse or av2");
  app.add_option("--vehicle-id", options.vehicle_id,
                 "Vehicle (DDS partition), instead of the configured one");
  app.add_option("--domain", options.domain, "DDS domain, instead of the configured one");
  app.add_option("--snapshot", options.snapshot_file,
                 "File that keeps the map for a restart, instead of the configured one");
  app.add_flag("--check-config", options.check_only, "Check the configuration and exit");
  app.add_flag("--dump-config", options.dump_only,
               "Print every key of the configuration with its value, unit, range and meaning, and exit");
  app.set_version_flag("--version", laneloom::core::version());
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& end) {
    std::ostringstream complaint;
    const int code = app.exit(end, std::cout, complaint);
    laneloom::service::print_error(complaint.str());
    return code == EX_OK ? EX_OK : EX_CONFIG;
  }
  return laneloom::service::start(options);
} catch (const laneloom::ConfigError& error) {
  laneloom::service::print_error(error.what());
  return EX_CONFIG;  // systemd does not start the service again: it would be refused again
} catch (const laneloom::dds::NotPermitted& error) {
  laneloom::service::print_error(error.what());
  return EX_NOPERM;  // systemd starts the service again: the clock may be wrong yet
} catch (const std::exception& error) {
  laneloom::service::print_error(error.what());
  return EXIT_FAILURE;
}
