#pragma once

#include <stdexcept>

namespace laneloom {

/// What is wrong with a configuration or a file that it names, in the form "file:line: key: what" (as much of
/// it as is known).
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace laneloom
