#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "laneloom/messages.hpp"

namespace laneloom {

/// By how much each counter rose since `previous`, of the same session. What did not rise is left out.
std::map<std::string, std::uint64_t> rises(const ServiceStatus& status, const ServiceStatus& previous);

/// For people, several lines; `previous` (null for the first) is of the same session.
std::string describe(const ServiceStatus& status, const ServiceStatus* previous);
/// For machines: one object; what is unknown is null.
nlohmann::json to_json(const ServiceStatus& status, const ServiceStatus* previous);

}  // namespace laneloom
