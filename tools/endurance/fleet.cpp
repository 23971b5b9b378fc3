#include "endurance/fleet.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace laneloom::endurance {
namespace {

std::string last_line(const std::string& file) {
  std::ifstream lines(file);
  std::string last;
  for (std::string line; std::getline(lines, line);) std::swap(last, line);
  return last.empty() ? "none" : last;
}

}  // namespace

Fleet::Fleet(Spec spec) : spec_(std::move(spec)) {
  std::ofstream config(folder_.file("laneloomd.yaml"));
  config << "service:\n  snapshot_file: " << folder_.file("snapshot") << "\n  snapshot_period_s: 0.5\n";
  config.close();
  if (!config) throw std::runtime_error(folder_.file("laneloomd.yaml") + ": cannot be written");
  for (const Member& member : members()) start(member);
}

std::vector<Fleet::Member> Fleet::members() const {
  std::vector<Member> result{kService, kPublisher, kPlanner};
  for (const auto& program : spec_.perceptions) result.push_back(program.filename());
  if (!spec_.stranger.empty()) result.emplace_back(kStranger);
  return result;
}

const std::string& Fleet::new_log() {
  logs_.push_back(folder_.file(fmt::format("publications_{}.csv", logs_.size()).c_str()));
  return logs_.back();
}

std::vector<std::string> Fleet::perception(const std::filesystem::path& program) {
  return {program, std::to_string(spec_.dds.domain), spec_.dds.vehicle_id, new_log()};
}

std::vector<std::string> Fleet::stranger() const {
  std::vector<std::string> command{spec_.stranger.front(),           "--only", "laneloomd",
                                   std::to_string(spec_.dds.domain), "0",      "1"};
  command.insert(command.end(), spec_.stranger.begin() + 1, spec_.stranger.end());
  return command;
}

std::vector<std::string> Fleet::command_of(const Member& member) {
  for (const auto& program : spec_.perceptions)
    if (program.filename() == member) return perception(program);
  if (member == kStranger) return stranger();
  std::vector<std::string> command;
  if (member == kPublisher) {
    command = {spec_.command, "publish", "--scenario", spec_.scenario, "--noise",
               spec_.noise,   "--loop",  "--times",    new_log()};
    command.insert(command.end(), {"--seed", std::to_string(logs_.size())});
  } else if (member == kService) {
    command = {spec_.service, "--config", folder_.file("laneloomd.yaml")};
  } else {
    command = {spec_.command, "pnc", "--json"};
  }
  command.insert(command.end(),
                 {"--domain", std::to_string(spec_.dds.domain), "--vehicle-id", spec_.dds.vehicle_id});
  return command;
}

void Fleet::start(const Member& member) {
  processes_[member] = std::make_unique<support::ChildProcess>(command_of(member), output_of(member));
}

void Fleet::signal(const Member& member, int number) { processes_.at(member)->signal(number); }

void Fleet::kill_and_restart(const Member& member) {
  processes_.erase(member);
  start(member);
}

std::string Fleet::stop(const Member& member) {
  const std::string failure = processes_.at(member)->stop();
  processes_.erase(member);
  return failure.empty() ? "" : fmt::format("the {}, told to end, {}", member, failure);
}

std::vector<std::string> Fleet::stop_perceptions() {
  std::vector<std::string> failures;
  for (const Member& member : members()) {
    if (member == kService || member == kPlanner) continue;
    if (std::string failure = stop(member); !failure.empty()) failures.push_back(std::move(failure));
  }
  return failures;
}

std::vector<std::string> Fleet::restart_ended() {
  std::vector<std::string> ends;
  for (const Member& member : members()) {
    support::ChildProcess& process = *processes_.at(member);
    if (process.running()) continue;
    const std::string failure = process.failure();
    ends.push_back(fmt::format("the {} {} by itself (its last words: {})", member,
                               failure.empty() ? "ended" : failure, last_line(output_of(member))));
    start(member);
  }
  return ends;
}

bool Fleet::planner_gets_maps(std::int64_t since_ns, std::chrono::milliseconds patience) const {
  return wait_for_planner(output_of(kPlanner), since_ns, patience);
}

std::string Fleet::restart(const Member& member) {
  std::string failure = stop(member);
  start(member);
  return failure;
}

std::vector<support::PublicationLog> Fleet::publications() const {
  std::vector<support::PublicationLog> result;
  result.reserve(logs_.size());
  for (const auto& log : logs_) {
    // Who is killed before it has begun its log has published nothing.
    std::error_code absent;
    const auto size = std::filesystem::file_size(log, absent);
    if (!absent && size > 0) result.push_back(support::read_publication_log(log));
  }
  return result;
}

}  // namespace laneloom::endurance
