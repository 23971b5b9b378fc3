#pragma once

#include <string>

#include "laneloom/messages.hpp"

namespace laneloom {

/// The status in the text format of Prometheus (version 0.0.4): what the status holds, and nothing else.
/// Times are in seconds.
std::string metrics(const ServiceStatus& status);

}  // namespace laneloom
