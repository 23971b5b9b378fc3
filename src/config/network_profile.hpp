#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "laneloom/error.hpp"
#include "laneloom/network_profile.hpp"

/// Files with profiles of networks: YAML, a map of sources, each a map of values by name:
///     front: {stddev_at_8_m: {value: 0.03, weight: 5400}, …}
namespace laneloom::config {

/// Throws ConfigError naming file, line and key for an unreadable file, bad YAML, a key that is unknown or
/// given twice, a value that is no number or beyond 1e9, and a weight that is not above 0. Mapper checks
/// whether a network has values of these names. An empty path gives no profiles.
NetworkProfiles load_network_profiles(const std::filesystem::path& path);

/// What was learned of networks in several drives: of each value the mean by weight, with the sum of the
/// weights, as far as a profile may have it.
NetworkProfiles merged(std::span<const NetworkProfiles> of_drives);

/// The text of profiles, as load_network_profiles() reads it back.
std::string dump(const NetworkProfiles& profiles);

}  // namespace laneloom::config
