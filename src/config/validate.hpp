#pragma once

#include <optional>
#include <string>

#include "laneloom/config.hpp"

namespace laneloom::config {

/// A problem of a configuration, with its key ("mapper.range.side_max_m").
struct Problem {
  std::string key;
  std::string what;  ///< goes on after the key: "must exceed 0.2 m"
};

/// Finds the first value outside its range, or else the first contradiction between values.
std::optional<Problem> find_problem(const Config& config);

}  // namespace laneloom::config
