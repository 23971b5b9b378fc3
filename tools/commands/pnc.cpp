#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>
#include <variant>

#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/inbox.hpp"
#include "commands/live_display.hpp"
#include "commands/options.hpp"
#include "commands/stop_signal.hpp"
#include "io/json_lines.hpp"
#include "laneloom/dds/reader.hpp"
#include "pnc/report.hpp"

namespace laneloom::commands {
namespace {

using SteadyClock = std::chrono::steady_clock;

struct PncOptions {
  DdsConfig dds;
  bool json = false;
  bool require_lanes = false;
  double duration_s = 0.0;
  std::string record;
};

/// An event of the service itself: its name for machines, and a text for people.
struct Notice {
  std::string event, text;
};
using Event = std::variant<PublishedMap, Notice>;
using Events = Inbox<Event>;  // when it is full, dropped maps count as missed

dds::ReaderCallbacks<PublishedMap> callbacks_into(Events& inbox) {
  return {.sample = [&inbox](PublishedMap&& map) { inbox.put(std::move(map)); },
          .refused =
              [&inbox](std::string_view reason) {
                inbox.put(Notice{"refused", fmt::format("a map was refused: {}", reason)});
              },
          .matched = {},
          .alive =
              [&inbox](int writers) {
                inbox.put(writers > 0 ? Notice{"alive", "the service is alive"}
                                      : Notice{"liveliness_lost", "THE SERVICE IS GONE OR HANGS"});
              },
          .deadline_missed =
              [&inbox](std::uint64_t total) {
                inbox.put(Notice{"deadline_missed", fmt::format("no map in time ({} times so far)", total)});
              }};
}

/// Shows updates as they come: redrawn in place on a terminal, otherwise as a line per second, or as JSON.
class Display {
 public:
  explicit Display(bool json) : json_(json) {}

  void show(const pnc::PncUpdate& update) {
    shown_.clear();
    if (json_) return output_.print_line(to_json(update).dump());
    if (output_.is_terminal()) return output_.redraw(describe(update));
    const bool due = SteadyClock::now() >= next_line_;
    if (!due && update.violations.empty()) return;
    if (due) next_line_ = SteadyClock::now() + std::chrono::seconds(1);
    output_.print_line(summarise(update));
  }

  void show(const Notice& notice) {
    if (json_) return output_.print_line(nlohmann::json{{"event", notice.event}}.dump());
    // A notice is shown once between two maps, because deadlines are missed again and again.
    if (!shown_.insert(notice.event).second) return;
    output_.print_line(notice.text);
  }

 private:
  bool json_;
  LiveDisplay output_;
  SteadyClock::time_point next_line_;
  std::set<std::string> shown_;  ///< notices since the last map
};

/// Counts of everything received so far.
struct Tally {
  std::uint64_t maps = 0, maps_with_lanes = 0, missed = 0, refused = 0, violations = 0;

  void add(const pnc::PncUpdate& update) {
    ++maps;
    if (!update.map.map.lanes.empty()) ++maps_with_lanes;
    missed += update.missed;
    violations += update.violations.size();
  }
  ExitCode exit_code(bool require_lanes) const {
    if (violations + refused > 0) return kFoundWrong;
    if (maps == 0) return kNobodyHeard;
    return require_lanes && maps_with_lanes == 0 ? kNothingToDriveOn : kDone;
  }
};

/// Follows the map until the time is over or the program is to end.
class Follower {
 public:
  explicit Follower(const PncOptions& options) : options_(options), display_(options.json) {
    if (!options.record.empty()) record_ = std::make_unique<io::JsonLinesWriter>(options.record);
  }

  Tally run() {
    Events inbox;
    const dds::Participant participant(options_.dds, "laneloom pnc");
    const dds::Reader<PublishedMap> reader(participant, callbacks_into(inbox));
    const auto end = SteadyClock::now() + std::chrono::duration<double>(options_.duration_s);
    while (!stop_requested() && (options_.duration_s == 0.0 || SteadyClock::now() < end)) {
      std::optional<Event> event = inbox.take(std::chrono::milliseconds(50));
      if (!event) continue;
      if (auto* map = std::get_if<PublishedMap>(&*event))
        receive(std::move(*map));
      else
        receive(std::get<Notice>(*event));
    }
    if (record_) record_->close();
    return tally_;
  }

 private:
  void receive(PublishedMap map) {
    pnc::PncUpdate update = pnc::judge(std::move(map), previous_ ? &*previous_ : nullptr);
    tally_.add(update);
    display_.show(update);
    const std::int64_t stamp_ns = update.map.map.stamp_ns;
    const bool is_new = !previous_ || previous_->map.stamp_ns != stamp_ns;
    if (record_ && is_new && stamp_ns != 0 && update.violations.empty()) record_->write(update.map.map);
    previous_ = std::move(update.map);
  }

  void receive(const Notice& notice) {
    if (notice.event == "refused") ++tally_.refused;
    display_.show(notice);
  }

  const PncOptions& options_;
  Display display_;
  std::unique_ptr<io::JsonLinesWriter> record_;
  std::optional<PublishedMap> previous_;
  Tally tally_;
};

void pnc(const PncOptions& options) {
  catch_stop_signals();
  const Tally tally = Follower(options).run();
  const ExitCode code = tally.exit_code(options.require_lanes);
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"event", "end"},
                                      {"maps", tally.maps},
                                      {"maps_with_lanes", tally.maps_with_lanes},
                                      {"missed", tally.missed},
                                      {"refused", tally.refused},
                                      {"violations", tally.violations},
                                      {"exit_code", +code}}
                           .dump());
  else
    fmt::print("{} maps ({} with lanes), {} missed, {} refused, {} contract violations\n", tally.maps,
               tally.maps_with_lanes, tally.missed, tally.refused, tally.violations);
  end_with(code);
}

}  // namespace

void add_pnc(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("pnc", "Planning participant: follows the map and checks its contract");
  command->footer(
      "Exit code: 0 maps were received, none broke the contract; 2 one did, or was refused; 3 no map came; "
      "4 no map had a lane (--require-lanes).");
  const auto options = std::make_shared<PncOptions>();
  add_dds(*command, options->dds);
  command->add_flag("--json", options->json, "One JSON object per update");
  add_text_output(*command, "--record", options->record, "Maps to write, one per fused frame (.jsonl)");
  command->add_option("--duration", options->duration_s, "Seconds; default: until it is ended")
      ->check(positive_seconds());
  command->add_flag("--require-lanes", options->require_lanes, "Fail if no map has a lane");
  command->callback([options] { pnc(*options); });
}

}  // namespace laneloom::commands
