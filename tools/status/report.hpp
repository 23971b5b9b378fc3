#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "laneloom/messages.hpp"

namespace laneloom::status {

/// The rise of each counter since `previous`, which is of the same session. Counters that did not rise are
/// left out.
std::map<std::string, std::uint64_t> rises(const ServiceStatus& status, const ServiceStatus& previous);

/// A text for people, of several lines. `previous` is of the same session; null for the first status.
std::string describe(const ServiceStatus& status, const ServiceStatus* previous);
/// An object for machines. Unknown values are null.
nlohmann::json to_json(const ServiceStatus& status, const ServiceStatus* previous);

}  // namespace laneloom::status
