#include "doctor/endpoints.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <iterator>

#include "laneloom/dds/topics.hpp"

namespace laneloom::doctor {
namespace {

const std::vector<std::string>& or_default(const std::vector<std::string>& partitions) {
  static const std::vector<std::string> kDefault{""};
  return partitions.empty() ? kDefault : partitions;
}

bool names_match(const std::string& a, const std::string& b) {
  return fnmatch(a.c_str(), b.c_str(), 0) == 0 || fnmatch(b.c_str(), a.c_str(), 0) == 0;
}

}  // namespace

bool partitions_match(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::ranges::any_of(or_default(a), [&](const std::string& one) {
    return std::ranges::any_of(or_default(b),
                               [&](const std::string& other) { return names_match(one, other); });
  });
}

bool is_of_vehicle(const dds::Endpoint& endpoint, const std::string& vehicle_id) {
  return partitions_match(endpoint.partitions, {vehicle_id});
}

std::vector<dds::Endpoint> select(const Observed& seen,
                                  const std::function<bool(const dds::Endpoint&)>& wanted) {
  std::vector<dds::Endpoint> result;
  std::ranges::copy_if(seen.endpoints, std::back_inserter(result), wanted);
  return result;
}

std::vector<dds::Endpoint> services(const Observed& seen) {
  return select(seen, [](const dds::Endpoint& endpoint) {
    return endpoint.is_writer && endpoint.topic == dds::kLaneMapTopic;
  });
}

std::string elsewhere(const Observed& seen) {
  std::vector<int> others = seen.listening_domains;
  std::erase(others, seen.dds.domain);
  return others.empty() ? ""
                        : fmt::format(" Processes of this host are in domain {}.", fmt::join(others, ", "));
}

std::string who(const dds::Peer& peer) {
  const std::string name = peer.name.empty() ? peer.id : fmt::format("\"{}\"", peer.name);
  return peer.address.empty() ? name : fmt::format("{} ({})", name, peer.address);
}

std::string partitions_text(const std::vector<std::string>& partitions) {
  if (partitions.empty()) return "the default partition";
  return fmt::format("the partition{} \"{}\"", partitions.size() > 1 ? "s" : "",
                     fmt::join(partitions, "\", \""));
}

}  // namespace laneloom::doctor
