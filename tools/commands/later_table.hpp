#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "evaluation/later.hpp"

namespace laneloom::commands {

/// A table of single detections and maps side by side. A dash stands for a value that cannot be told.
std::string later_table(const evaluation::LaterMeter& meter);

/// The same as JSON. Shares are 0..1; a value that cannot be told is null.
nlohmann::json later_json(const evaluation::LaterMeter& meter);

}  // namespace laneloom::commands
