#pragma once

#include <string>

#include "laneloom/config.hpp"
#include "mapping/state.hpp"

namespace laneloom {

/// The whole state of a mapper as bytes: the same state gives the same bytes, on every host.
std::string to_bytes(const MapperState& state);

/// The state that to_bytes() was given, for a mapper of the same configuration. Throws std::runtime_error
/// where the bytes end too early or were not written by to_bytes() of this version.
MapperState from_bytes(const std::string& bytes, const MapperConfig& config);

}  // namespace laneloom
