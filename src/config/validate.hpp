#pragma once

#include <optional>
#include <string>

#include "laneloom/config.hpp"

namespace laneloom::config {

/// What is wrong with a configuration, and at which key ("mapper.range.side_max_m").
struct Problem {
  std::string key;
  std::string what;
};

/// The first value outside its range, else the first contradiction between values.
std::optional<Problem> find_problem(const Config& config);

}  // namespace laneloom::config
