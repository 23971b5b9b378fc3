#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "laneloom/messages.hpp"

namespace laneloom::status {

/// The rise of each counter since `previous`, which is of the same session. Counters that did not rise are
/// left out.
std::map<std::string, std::uint64_t> rises(const ServiceStatus& status, const ServiceStatus& previous);

/// The value of a key of the service's configuration, as in the file. Empty: the service does not tell it.
std::string setting(const ServiceStatus& status, std::string_view key);

/// A text for people, of several lines. `previous` is of the same session; null for the first status.
std::string describe(const ServiceStatus& status, const ServiceStatus* previous);
/// An object for machines. Unknown values are null.
nlohmann::json to_json(const ServiceStatus& status, const ServiceStatus* previous);

}  // namespace laneloom::status
