#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/inbox.hpp"
#include "commands/live_display.hpp"
#include "commands/options.hpp"
#include "commands/stop_signal.hpp"
#include "io/json_text.hpp"
#include "laneloom/dds/reader.hpp"
#include "status/report.hpp"

namespace laneloom::commands {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr double kPatience_s = 5.0;  ///< for the first status, with --once
/// A service that was silent for this long is no longer shown beside one that is heard.
constexpr std::chrono::seconds kForgotten{10};

struct StatusOptions {
  DdsConfig dds;
  bool json = false;
  bool once = false;
  double duration_s = 0.0;
};

struct Refused {
  std::string reason;
};
using Events = Inbox<std::variant<ServiceStatus, Refused>>;

ExitCode code_of(MapState state) {
  switch (state) {
    case MapState::ok:
      return kDone;
    case MapState::degraded:
      return kFoundWrong;
    case MapState::stale:
      break;
  }
  return kNothingToDriveOn;
}

/// The last status of one service.
struct Heard {
  ServiceStatus status;
  std::optional<ServiceStatus> previous;
  SteadyClock::time_point when;

  const ServiceStatus* before() const { return previous ? &*previous : nullptr; }
};

/// Follows the services of one vehicle, of which there should be one.
class Watch {
 public:
  explicit Watch(const StatusOptions& options) : options_(options) {}

  /// Follows the services. Returns the exit code by the newest status.
  ExitCode run() {
    Events inbox;
    const dds::Participant participant(options_.dds, "laneloom status");
    const dds::Reader<ServiceStatus> reader(
        participant,
        {.sample = [&inbox](ServiceStatus&& status) { inbox.put(std::move(status)); },
         .refused = [&inbox](std::string_view reason) { inbox.put(Refused{std::string(reason)}); }});
    const double duration_s = options_.once && options_.duration_s == 0.0 ? kPatience_s : options_.duration_s;
    const auto end = SteadyClock::now() + std::chrono::duration<double>(duration_s);
    while (!stop_requested() && (duration_s == 0.0 || SteadyClock::now() < end)) {
      const auto event = inbox.take(std::chrono::milliseconds(200));
      if (event) std::visit([this](const auto& what) { receive(what); }, *event);
      if (options_.once && !heard_.empty()) break;
      if (!options_.json && !options_.once && output_.is_terminal()) output_.redraw(overview());
    }
    return exit_code_;
  }

 private:
  void receive(const ServiceStatus& status) {
    const auto now = SteadyClock::now();
    std::erase_if(heard_, [&](const auto& entry) { return now - entry.second.when > kForgotten; });
    Heard& heard = heard_[status.session_id];
    if (heard.when != SteadyClock::time_point()) heard.previous = std::move(heard.status);
    heard.status = status;
    heard.when = now;
    exit_code_ = code_of(status.state);
    if (options_.json) {
      output_.print_line(io::json_text(status::to_json(status, heard.before())));
    } else if (options_.once || !output_.is_terminal()) {
      output_.print_line(status::describe(status, heard.before()));
    }
  }

  void receive(const Refused& refused) {
    if (options_.json) return output_.print_line(R"({"event":"refused"})");
    output_.print_line("a status was refused: " + refused.reason);
  }

  std::string overview() const {
    if (heard_.empty())
      return fmt::format("no service of vehicle \"{}\" in domain {} so far\n", options_.dds.vehicle_id,
                         options_.dds.domain);
    std::string text;
    if (heard_.size() > 1) text = fmt::format("{} SERVICES OF ONE VEHICLE\n\n", heard_.size());
    for (const auto& [session, heard] : heard_) {
      const std::chrono::duration<double> silence = SteadyClock::now() - heard.when;
      text += status::describe(heard.status, heard.before()) +
              fmt::format("heard           {:.1f} s ago\n\n", silence.count());
    }
    return text;
  }

  const StatusOptions& options_;
  LiveDisplay output_;
  std::map<std::uint64_t, Heard> heard_;  ///< by session
  ExitCode exit_code_ = kNobodyHeard;
};

void status(const StatusOptions& options) {
  catch_stop_signals();
  const ExitCode code = Watch(options).run();
  if (code == kNobodyHeard && !options.json)
    fmt::print(stderr, "laneloom: no service of vehicle \"{}\" was heard in domain {}\n",
               options.dds.vehicle_id, options.dds.domain);
  end_with(code);
}

}  // namespace

void add_status(CLI::App& app) {
  CLI::App* command = app.add_subcommand("status", "Health of the running service, live");
  command->footer("Exit code, by the newest status: 0 OK; 2 DEGRADED; 4 STALE; 3 no service was heard.");
  const auto options = std::make_shared<StatusOptions>();
  add_dds(*command, options->dds);
  command->add_flag(
      "--once", options->once,
      fmt::format("End with the first status; without --duration, wait {} s for it", kPatience_s));
  command->add_flag("--json", options->json, "One JSON object per status");
  command->add_option("--duration", options->duration_s, "Seconds; default: until it is ended")
      ->check(positive_seconds());
  command->callback([options] { status(*options); });
}

}  // namespace laneloom::commands
