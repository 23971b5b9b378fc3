#include "endurance/soak.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "simulation/random.hpp"

namespace laneloom {
namespace {

using Seconds = std::chrono::duration<double>;
using Member = Fleet::Member;
constexpr std::chrono::seconds kPatience{30};

struct Fault {
  const char* name;
  void (*make)(Fleet& fleet, Member member, Random& random);
};

void hang(Fleet& fleet, Member member, Random& random) {
  fleet.signal(member, SIGSTOP);
  std::this_thread::sleep_for(Seconds(random.uniform(0.2, 3.0)));
  fleet.signal(member, SIGCONT);
}

const std::array kFaults{
    Fault{"kill", [](Fleet& fleet, Member member, Random& /*random*/) { fleet.kill_and_restart(member); }},
    Fault{"end", [](Fleet& fleet, Member member, Random& /*random*/) { fleet.restart(member); }},
    Fault{"hang", hang}, Fault{"reload", [](Fleet& fleet, Member /*member*/, Random& /*random*/) {
                                 fleet.signal(Member::service, SIGHUP);
                               }}};

/// Its name.
std::string make_a_fault(Fleet& fleet, Random& random) {
  constexpr std::array kMembers{Member::publisher, Member::service, Member::planner};
  const Member member = kMembers.at(random.below(kMembers.size()));
  const Fault& fault = kFaults.at(random.below(kFaults.size()));
  fault.make(fleet, member, random);
  return std::string(fault.name) == "reload" ? "reload service"
                                             : fmt::format("{} {}", fault.name, name(member));
}

}  // namespace

bool SoakResult::passed() const {
  const bool explained = std::all_of(accounts.begin(), accounts.end(),
                                     [](const auto& session) { return session.second.unexplained() == 0; });
  return explained && !accounts.empty() && maps.violations.empty() && unrecovered.empty();
}

SoakResult soak(const SoakSpec& spec, const std::function<bool()>& go_on) {
  Random random(spec.seed);
  SoakResult result;
  Watch watch(spec.fleet.dds);
  Fleet fleet(spec.fleet);
  if (!watch.wait_for_good_map(kPatience)) throw std::runtime_error("no good map came");

  const auto end = std::chrono::steady_clock::now() + spec.duration;
  while (std::chrono::steady_clock::now() < end && go_on()) {
    const std::string fault = make_a_fault(fleet, random);
    ++result.faults[fault];
    if (!watch.wait_for_good_map(kPatience)) result.unrecovered.push_back(fault);
    std::this_thread::sleep_for(Seconds(random.uniform(0.5, 4.0)));
  }
  fleet.stop(Member::publisher);
  if (!watch.wait_for_settled_status(kPatience)) result.unrecovered.emplace_back("end of the publisher");

  const auto publications = fleet.publications();
  for (const auto& [id, session] : watch.sessions()) {
    result.accounts.emplace(id, account_of(session.last, session.sources, publications));
  }
  result.maps = watch.maps();
  return result;
}

}  // namespace laneloom
