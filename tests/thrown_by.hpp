#pragma once

#include <stdexcept>
#include <string>

namespace laneloom {

/// The text of the exception that `act` throws. Empty: it throws none.
template <class Error = std::runtime_error, class Act>
std::string thrown_by(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace laneloom
