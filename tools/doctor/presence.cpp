#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"

namespace laneloom::doctor {
namespace {

Finding empty_domain(const Observed& seen) {
  return {"empty_domain", fmt::format("Nobody else is in domain {}.{}", seen.dds.domain, elsewhere(seen)),
          "Participants of different domains never see each other.",
          "Start all with the same domain (dds.domain, --domain). Those on other hosts also need a network "
          "that passes multicast, or a profile with their addresses (dds.profile_file), and UDP ports from "
          "7400 on that no firewall closes; with DDS-Security, an identity that they trust (--security)."};
}

Finding no_discovery_server(const Observed& seen) {
  return {"no_discovery_server",
          fmt::format("No discovery server answers at {}.", fmt::join(seen.discovery_servers, ", nor at ")),
          "Participants with these settings (dds.profile_file) find each other through it alone.",
          "Start it (fastdds discovery), or mend its address or number in the profile; a firewall must pass "
          "its port."};
}

Finding no_service(const Observed& seen, const std::vector<dds::Endpoint>& all) {
  std::set<std::string> others;
  for (const auto& service : all) others.insert(partitions_text(service.partitions));
  const std::string of_others = others.empty()
                                    ? elsewhere(seen)
                                    : fmt::format(" There are services in {}.", fmt::join(others, ", in "));
  return {"no_service",
          fmt::format("No service publishes maps for vehicle \"{}\" in domain {}.{}", seen.dds.vehicle_id,
                      seen.dds.domain, of_others),
          "Without it there are no maps. Each vehicle has a partition of its own, named by its id.",
          others.empty() ? "Start laneloomd (systemctl status laneloom tells why it does not run)."
                         : "Use one vehicle id in all participants (dds.vehicle_id, --vehicle-id)."};
}

/// A service that nobody hears, though a process of it is on this host. None: there is no such process.
std::optional<Finding> unheard_process(const Observed& seen) {
  const auto& processes = seen.service_processes;
  if (processes.empty()) return std::nullopt;
  if (auto stopped = stopped_service(seen)) return stopped;
  return Finding{"service_unheard",
                 fmt::format("laneloomd runs in domain {} on this host (process {}), but does not answer.",
                             seen.dds.domain, processes.front().id),
                 "A service that hangs, or hears nothing, is matched by nobody.",
                 "Restart it (systemctl restart laneloom), and see its log."};
}

Finding two_services(const Observed& seen, const std::vector<dds::Endpoint>& all) {
  std::vector<std::string> names;
  std::ranges::transform(all, std::back_inserter(names),
                         [](const auto& service) { return who(service.participant); });
  return {"two_services",
          fmt::format("{} services publish maps for vehicle \"{}\": {}.", all.size(), seen.dds.vehicle_id,
                      fmt::join(names, ", ")),
          "Readers get the maps of both in turn, with ids that have nothing to do with each other.",
          "End one of them, or give each vehicle an id of its own."};
}

}  // namespace

std::optional<Finding> stopped_service(const Observed& seen) {
  const auto stopped = std::ranges::find_if(seen.service_processes, &ServiceProcess::stopped);
  if (stopped == seen.service_processes.end()) return std::nullopt;
  return Finding{
      "service_stopped", fmt::format("laneloomd is stopped (process {}).", stopped->id),
      "A process that is stopped (SIGSTOP, a debugger) does nothing, and does not end either.",
      fmt::format("Let it go on (kill -CONT {}), or restart it (systemctl restart laneloom).", stopped->id)};
}

Findings presence_findings(const Observed& seen) {
  if (seen.participants.empty()) {
    Findings found{seen.discovery_servers.empty() ? empty_domain(seen) : no_discovery_server(seen)};
    if (const auto process = unheard_process(seen)) found.insert(found.begin(), *process);
    return found;
  }
  const auto all = services(seen);
  std::vector<dds::Endpoint> ours;
  std::ranges::copy_if(all, std::back_inserter(ours),
                       [&](const auto& service) { return is_of_vehicle(service, seen.dds.vehicle_id); });
  if (ours.empty() && all.empty())
    if (const auto process = unheard_process(seen)) return {*process};
  if (ours.empty()) return {no_service(seen, all)};
  if (ours.size() > 1) return {two_services(seen, ours)};
  return {};
}

}  // namespace laneloom::doctor
