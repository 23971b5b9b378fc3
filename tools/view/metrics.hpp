#pragma once

#include <string>

#include "laneloom/messages.hpp"

namespace laneloom::view {

/// The values of a status in the text format of Prometheus (version 0.0.4). Times are in seconds.
std::string metrics(const ServiceStatus& status);

}  // namespace laneloom::view
