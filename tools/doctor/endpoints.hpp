#pragma once

#include <functional>
#include <string>
#include <vector>

#include "doctor/observed.hpp"

namespace laneloom::doctor {

/// Whether writers in some of `a` match readers in some of `b`; names may have wildcards.
bool partitions_match(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// Whether an endpoint is in the partition of the vehicle.
bool is_of_vehicle(const dds::Endpoint& endpoint, const std::string& vehicle_id);

/// The endpoints for which `wanted` is true.
std::vector<dds::Endpoint> select(const Observed& seen,
                                  const std::function<bool(const dds::Endpoint&)>& wanted);

/// The endpoints that publish the lane map of any vehicle.
std::vector<dds::Endpoint> services(const Observed& seen);

/// A sentence on the domains that other processes of this host are in; empty: they are in none.
std::string elsewhere(const Observed& seen);

/// The text for a participant: `"laneloomd" (10.0.0.3)`.
std::string who(const dds::Peer& peer);
/// The text for partitions: `the partition "car-1"`, `the partitions …`, or `the default partition`.
std::string partitions_text(const std::vector<std::string>& partitions);

}  // namespace laneloom::doctor
