#pragma once

#include <stdexcept>

namespace laneloom {

/// An error of a configuration or of a file that it names. what() reads "file:line: key: reason"; parts that
/// are not known are left out.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace laneloom
