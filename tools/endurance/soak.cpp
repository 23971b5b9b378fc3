#include "endurance/soak.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "base/clock.hpp"
#include "simulation/random.hpp"

namespace laneloom::endurance {
namespace {

using Seconds = std::chrono::duration<double>;
using Member = Fleet::Member;

struct Fault {
  std::string name;
  /// Makes the fault. Returns the problem, in words; empty: there was none.
  std::function<std::string(Fleet& fleet, simulation::Random& random)> make;
};

std::string hang(Fleet& fleet, const Member& member, simulation::Random& random) {
  fleet.signal(member, SIGSTOP);
  std::this_thread::sleep_for(Seconds(random.uniform(0.2, 3.0)));
  fleet.signal(member, SIGCONT);
  return {};
}

std::string reload(Fleet& fleet) {
  fleet.signal(Fleet::kService, SIGHUP);
  return {};
}

std::string crash(Fleet& fleet, const Member& member) {
  fleet.kill_and_restart(member);
  return {};
}

std::vector<Fault> all_faults(const Fleet& fleet) {
  std::vector<Fault> faults{
      {"reload service", [](Fleet& faulty, simulation::Random& /*random*/) { return reload(faulty); }}};
  for (const Member& member : fleet.members()) {
    faults.push_back({"kill " + member, [member](Fleet& faulty, simulation::Random& /*random*/) {
                        return crash(faulty, member);
                      }});
    faults.push_back({"end " + member, [member](Fleet& faulty, simulation::Random& /*random*/) {
                        return faulty.restart(member);
                      }});
    faults.push_back({"hang " + member, [member](Fleet& faulty, simulation::Random& random) {
                        return hang(faulty, member, random);
                      }});
  }
  return faults;
}

/// Seconds until the planner has a map with a frame from after this call. None: it has none within
/// `patience`.
std::optional<double> recovery_s(const Fleet& fleet, std::chrono::seconds patience) {
  const auto start = std::chrono::steady_clock::now();
  if (!fleet.planner_gets_maps(system_now_ns(), patience)) return std::nullopt;
  return Seconds(std::chrono::steady_clock::now() - start).count();
}

/// Waits for the maps that must follow a fault. Returns the problem, in words; empty: there was none.
std::string follow(const SoakSpec& spec, const Watch& watch, const Fleet& fleet, FaultCount& count) {
  const std::optional<double> planner_s = recovery_s(fleet, spec.patience);
  if (!planner_s) return "the planner got no map";
  count.longest_recovery_s = std::max(count.longest_recovery_s, *planner_s);
  if (*planner_s > spec.recovery.count())
    return fmt::format("the planner got a map only {:.1f} s", *planner_s);
  return watch.wait_for_good_map(spec.patience) ? "" : "no good map came";
}

/// The perceptions of which no service fused a frame.
std::vector<std::string> never_fused(const Fleet::Spec& fleet,
                                     const std::map<std::uint64_t, Watch::Session>& sessions) {
  std::vector<std::string> result;
  for (const auto& program : fleet.perceptions) {
    const auto fused_it = [&](const auto& session) {
      return std::ranges::any_of(session.second.sources, [&](const SourceStatus& source) {
        return source.source == program.filename() && source.fused > 0;
      });
    };
    if (std::ranges::none_of(sessions, fused_it)) result.push_back(program.filename());
  }
  return result;
}

/// How many datagrams the services refused.
std::uint64_t refused_datagrams(const std::map<std::uint64_t, Watch::Session>& sessions) {
  std::uint64_t result = 0;
  for (const auto& [id, session] : sessions)
    for (const auto& [counter, count] : session.last.counters)
      if (counter.starts_with("datagrams_refused_")) result += count;
  return result;
}

}  // namespace

bool SoakResult::passed() const {
  const bool explained = std::all_of(accounts.begin(), accounts.end(),
                                     [](const auto& session) { return session.second.unexplained() == 0; });
  return explained && !accounts.empty() && maps.violations.empty() && failures.empty();
}

SoakResult soak(const SoakSpec& spec, const std::function<bool()>& go_on) {
  simulation::Random random(spec.seed);
  SoakResult result;
  Watch watch(spec.fleet.dds);
  Fleet fleet(spec.fleet);
  if (!watch.wait_for_good_map(spec.patience)) throw std::runtime_error("no good map came");

  const auto faults = all_faults(fleet);
  const auto end = std::chrono::steady_clock::now() + spec.duration;
  while (std::chrono::steady_clock::now() < end && go_on()) {
    const Fault& fault = faults[random.below(faults.size())];
    const std::string wrong_end = fault.make(fleet, random);
    if (!wrong_end.empty()) result.failures.push_back(wrong_end);
    FaultCount& count = result.faults[fault.name];
    ++count.times;
    const std::string failure = follow(spec, watch, fleet, count);
    if (!failure.empty()) result.failures.push_back(fmt::format("{} after: {}", failure, fault.name));
    std::this_thread::sleep_for(Seconds(random.uniform(0.5, 4.0)));
    for (const std::string& unwanted : fleet.restart_ended())
      result.failures.push_back(fmt::format("{} after: {}", unwanted, fault.name));
  }
  for (std::string& wrong_end : fleet.stop_perceptions()) result.failures.push_back(std::move(wrong_end));
  if (!watch.wait_for_settled_status(spec.patience))
    result.failures.emplace_back("no settled status came after the publisher's end");

  const auto publications = fleet.publications();
  const auto sessions = watch.sessions();
  for (const std::string& name : never_fused(spec.fleet, sessions))
    result.failures.push_back(fmt::format("no frame of the {} was fused", name));
  result.refused_datagrams = refused_datagrams(sessions);
  if (!spec.fleet.stranger.empty() && result.refused_datagrams == 0)
    result.failures.emplace_back("nothing of the stranger was refused");
  for (const auto& [id, session] : sessions) {
    result.accounts.emplace(id, account_of(session.last, session.sources, publications));
  }
  result.maps = watch.maps();
  return result;
}

}  // namespace laneloom::endurance
