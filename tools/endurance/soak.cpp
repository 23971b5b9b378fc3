#include "endurance/soak.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "simulation/random.hpp"

namespace laneloom {
namespace {

using Seconds = std::chrono::duration<double>;
using Member = Fleet::Member;

struct Fault {
  std::string name;
  /// Returns what went wrong, in words.
  std::function<std::string(Fleet& fleet, Random& random)> make;
};

std::string hang(Fleet& fleet, Member member, Random& random) {
  fleet.signal(member, SIGSTOP);
  std::this_thread::sleep_for(Seconds(random.uniform(0.2, 3.0)));
  fleet.signal(member, SIGCONT);
  return {};
}

std::string reload(Fleet& fleet) {
  fleet.signal(Member::service, SIGHUP);
  return {};
}

std::string crash(Fleet& fleet, Member member) {
  fleet.kill_and_restart(member);
  return {};
}

std::vector<Fault> all_faults() {
  std::vector<Fault> faults{
      {"reload service", [](Fleet& fleet, Random& /*random*/) { return reload(fleet); }}};
  for (const Member member : {Member::publisher, Member::service, Member::planner}) {
    const std::string name = Fleet::name(member);
    faults.push_back(
        {"kill " + name, [member](Fleet& fleet, Random& /*random*/) { return crash(fleet, member); }});
    faults.push_back(
        {"end " + name, [member](Fleet& fleet, Random& /*random*/) { return fleet.restart(member); }});
    faults.push_back(
        {"hang " + name, [member](Fleet& fleet, Random& random) { return hang(fleet, member, random); }});
  }
  return faults;
}

/// Who got no good map in time, in words; empty: nobody.
std::string without_map(const Watch& watch, const Fleet& fleet, std::chrono::seconds patience) {
  if (!watch.wait_for_good_map(patience)) return "no good map came";
  if (!fleet.planner_gets_maps(watch.newest(), patience)) return "the planner got no map";
  return {};
}

}  // namespace

bool SoakResult::passed() const {
  const bool explained = std::all_of(accounts.begin(), accounts.end(),
                                     [](const auto& session) { return session.second.unexplained() == 0; });
  return explained && !accounts.empty() && maps.violations.empty() && failures.empty();
}

SoakResult soak(const SoakSpec& spec, const std::function<bool()>& go_on) {
  Random random(spec.seed);
  SoakResult result;
  Watch watch(spec.fleet.dds);
  Fleet fleet(spec.fleet);
  if (!watch.wait_for_good_map(spec.patience)) throw std::runtime_error("no good map came");

  const auto faults = all_faults();
  const auto end = std::chrono::steady_clock::now() + spec.duration;
  while (std::chrono::steady_clock::now() < end && go_on()) {
    const Fault& fault = faults[random.below(faults.size())];
    const std::string wrong_end = fault.make(fleet, random);
    if (!wrong_end.empty()) result.failures.push_back(wrong_end);
    ++result.faults[fault.name];
    const std::string failure = without_map(watch, fleet, spec.patience);
    if (!failure.empty()) result.failures.push_back(fmt::format("{} after: {}", failure, fault.name));
    std::this_thread::sleep_for(Seconds(random.uniform(0.5, 4.0)));
    for (const Member member : fleet.restart_ended()) {
      result.failures.push_back(fmt::format("the {} ended after: {}", Fleet::name(member), fault.name));
    }
  }
  if (const std::string wrong_end = fleet.stop(Member::publisher); !wrong_end.empty())
    result.failures.push_back(wrong_end);
  if (!watch.wait_for_settled_status(spec.patience))
    result.failures.emplace_back("no settled status came after the publisher's end");

  const auto publications = fleet.publications();
  for (const auto& [id, session] : watch.sessions()) {
    result.accounts.emplace(id, account_of(session.last, session.sources, publications));
  }
  result.maps = watch.maps();
  return result;
}

}  // namespace laneloom
