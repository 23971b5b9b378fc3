#include <fmt/format.h>

#include <algorithm>

#include "doctor/endpoints.hpp"
#include "doctor/findings.hpp"

namespace laneloom::doctor {
namespace {

using dds::Endpoint;

const char* text(dds::Durability kind) {
  switch (kind) {
    case dds::Durability::volatile_:
      return "volatile";
    case dds::Durability::transient_local:
      return "transient local";
    case dds::Durability::transient:
      return "transient";
    case dds::Durability::persistent:
      return "persistent";
  }
  return "unknown";
}

const char* text(dds::Liveliness kind) {
  switch (kind) {
    case dds::Liveliness::automatic:
      return "automatic";
    case dds::Liveliness::manual_by_participant:
      return "manual by participant";
    case dds::Liveliness::manual_by_topic:
      return "manual by topic";
  }
  return "unknown";
}

std::string text(const std::optional<double>& duration_s) {
  return duration_s ? fmt::format("{} s", *duration_s) : "infinite";
}

const char* reliability(const Endpoint& endpoint) { return endpoint.reliable ? "reliable" : "best effort"; }
const char* ownership(const Endpoint& endpoint) { return endpoint.exclusive ? "exclusive" : "shared"; }

/// Whether `a` is longer than `b`. None stands for infinite.
bool is_longer(const std::optional<double>& a, const std::optional<double>& b) {
  return b && (!a || *a > *b);
}

/// The policies by which the writer offers less than the reader asks for.
std::vector<std::string> mismatches(const Endpoint& writer, const Endpoint& reader) {
  std::vector<std::string> result;
  const auto require = [&](bool holds, const char* policy, const auto& offered, const auto& requested) {
    if (!holds) result.push_back(fmt::format("{} (offered: {}, requested: {})", policy, offered, requested));
  };
  require(writer.reliable || !reader.reliable, "reliability", reliability(writer), reliability(reader));
  require(writer.durability >= reader.durability, "durability", text(writer.durability),
          text(reader.durability));
  require(!is_longer(writer.deadline_s, reader.deadline_s), "deadline", text(writer.deadline_s),
          text(reader.deadline_s));
  require(writer.liveliness >= reader.liveliness, "liveliness", text(writer.liveliness),
          text(reader.liveliness));
  require(!is_longer(writer.lease_s, reader.lease_s), "liveliness lease", text(writer.lease_s),
          text(reader.lease_s));
  require(writer.exclusive == reader.exclusive, "ownership", ownership(writer), ownership(reader));
  return result;
}

/// Whether another reader of the same participant matches the writer. A participant may have a reader for
/// each kind of writers.
bool another_matches(const Endpoint& writer, const Endpoint& reader, const std::vector<Endpoint>& endpoints) {
  return std::ranges::any_of(endpoints, [&](const Endpoint& other) {
    return !other.is_writer && other.participant.id == reader.participant.id && other.topic == reader.topic &&
           other.type == reader.type && mismatches(writer, other).empty();
  });
}

}  // namespace

Findings qos_findings(const Observed& seen) {
  const auto ours = select(seen, [&](const Endpoint& endpoint) {
    return endpoint.topic.starts_with("laneloom/") && is_of_vehicle(endpoint, seen.dds.vehicle_id);
  });
  Findings found;
  for (const Endpoint& writer : ours) {
    for (const Endpoint& reader : ours) {
      if (!writer.is_writer || reader.is_writer || writer.topic != reader.topic || writer.type != reader.type)
        continue;
      const auto policies = mismatches(writer, reader);
      if (policies.empty() || another_matches(writer, reader, ours)) continue;
      found.push_back({"qos_mismatch",
                       fmt::format("{} writes {}, but {} can't read it: {}.", who(writer.participant),
                                   writer.topic, who(reader.participant), fmt::join(policies, ", ")),
                       "A writer and a reader only match if the writer offers at least what the reader asks "
                       "for; else nothing is sent. Their listeners may be told, but nobody else.",
                       "Let the reader ask for less, or the writer offer more. The service's own QoS is in "
                       "the table of topics of idl/README.md."});
    }
  }
  return found;
}

}  // namespace laneloom::doctor
