#include "endurance/fleet.hpp"

#include <fmt/format.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace laneloom {

const char* Fleet::name(Member member) {
  switch (member) {
    case Member::publisher:
      return "publisher";
    case Member::service:
      return "service";
    case Member::planner:
      return "planner";
  }
  return "";
}

Fleet::Fleet(Spec spec) : spec_(std::move(spec)) {
  std::ofstream config(folder_.file("laneloomd.yaml"));
  config << "service:\n  snapshot_file: " << folder_.file("snapshot") << "\n  snapshot_period_s: 0.5\n";
  config.close();
  if (!config) throw std::runtime_error(folder_.file("laneloomd.yaml") + ": cannot be written");
  for (const Member member : {Member::service, Member::publisher, Member::planner}) start(member);
}

std::vector<std::string> Fleet::vehicle() const {
  return {"--domain", std::to_string(spec_.dds.domain), "--vehicle-id", spec_.dds.vehicle_id};
}

std::vector<std::string> Fleet::command_of(Member member) {
  switch (member) {
    case Member::publisher:
      logs_.push_back(folder_.file(fmt::format("publications_{}.csv", logs_.size()).c_str()));
      return {spec_.command,  "publish",   "--scenario",
              spec_.scenario, "--noise",   spec_.noise,
              "--loop",       "--seed",    std::to_string(logs_.size()),
              "--times",      logs_.back()};
    case Member::service:
      return {spec_.service, "--config", folder_.file("laneloomd.yaml")};
    case Member::planner:
      break;
  }
  return {spec_.command, "pnc", "--json"};
}

void Fleet::start(Member member) {
  auto command = command_of(member);
  const auto more = vehicle();
  command.insert(command.end(), more.begin(), more.end());
  processes_[member] = std::make_unique<ChildProcess>(command, output_of(member));
}

void Fleet::signal(Member member, int number) { kill(processes_.at(member)->id(), number); }

void Fleet::kill_and_restart(Member member) {
  processes_.erase(member);
  start(member);
}

std::string Fleet::stop(Member member) {
  const std::string failure = processes_.at(member)->stop();
  processes_.erase(member);
  return failure.empty() ? "" : fmt::format("the {}, told to end, {}", name(member), failure);
}

std::vector<Fleet::Member> Fleet::restart_ended() {
  std::vector<Member> ended;
  for (const auto& [member, process] : processes_) {
    if (!process->running()) ended.push_back(member);
  }
  for (const Member member : ended) start(member);
  return ended;
}

bool Fleet::planner_gets_maps(const MapNumber& newest, std::chrono::seconds patience) const {
  return wait_for_planner(output_of(Member::planner), newest, patience);
}

std::string Fleet::restart(Member member) {
  std::string failure = stop(member);
  start(member);
  return failure;
}

std::vector<PublicationLog> Fleet::publications() const {
  std::vector<PublicationLog> result;
  result.reserve(logs_.size());
  for (const auto& log : logs_) result.push_back(read_publication_log(log));
  return result;
}

}  // namespace laneloom
