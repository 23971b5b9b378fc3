#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation/lane_metres.hpp"

namespace laneloom::commands {

/// Where the metres of published lanes lie, as text. Empty: there are none.
std::string lane_metres_table(const evaluation::LaneMetres& metres);
/// The same; lengths in metres, shares 0..1, null where nothing tells.
nlohmann::json lane_metres_json(const evaluation::LaneMetres& metres);

}  // namespace laneloom::commands
