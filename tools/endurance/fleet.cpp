#include "endurance/fleet.hpp"

#include <fmt/format.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace laneloom {

const char* name(Fleet::Member member) {
  switch (member) {
    case Fleet::Member::publisher:
      return "publisher";
    case Fleet::Member::service:
      return "service";
    case Fleet::Member::planner:
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
  return {spec_.command, "pnc"};
}

void Fleet::start(Member member) {
  auto command = command_of(member);
  const auto more = vehicle();
  command.insert(command.end(), more.begin(), more.end());
  processes_[member] = std::make_unique<ChildProcess>(command, folder_.file(name(member)));
}

void Fleet::signal(Member member, int number) { kill(processes_[member]->id(), number); }

void Fleet::kill_and_restart(Member member) {
  processes_[member].reset();
  start(member);
}

void Fleet::stop(Member member) { processes_[member]->stop(); }

void Fleet::restart(Member member) {
  stop(member);
  start(member);
}

std::vector<PublicationLog> Fleet::publications() const {
  std::vector<PublicationLog> result;
  result.reserve(logs_.size());
  for (const auto& log : logs_) result.push_back(read_publication_log(log));
  return result;
}

}  // namespace laneloom
