#pragma once

#include "laneloom/config.hpp"
#include "laneloom/error.hpp"
#include "laneloom/sd_map.hpp"

namespace laneloom::sd_map {

/// Throws ConfigError if the file is not a regular one, or is larger than 128 MB. It is not read.
void check_sd_map_file(const SdMapConfig& config);

/// Reads an OpenStreetMap extract (XML): its highways for motor vehicles, one-way streets and turn
/// restrictions, with the map frame's origin as configured: x east, y north. An empty file name gives an
/// empty map. Throws ConfigError as check_sd_map_file(), and if the file cannot be read, or holds no street
/// or more than 20000 km of them. The error names the file and, if possible, the element.
SdMap load_sd_map(const SdMapConfig& config);

}  // namespace laneloom::sd_map
