#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation/later.hpp"

namespace laneloom {

/// Single detections and maps side by side. A dash stands for what cannot be told.
std::string later_table(const LaterMeter& meter);

/// The same for machines; shares are 0..1, and what cannot be told is null.
nlohmann::json later_json(const LaterMeter& meter);

}  // namespace laneloom
