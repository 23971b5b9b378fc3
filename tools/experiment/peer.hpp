#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"

namespace laneloom {

/// Another program that fuses frames as JSON lines into maps as JSON lines: `PROGRAM --in F --out F --report
/// F
/// --preset P`.
struct Peer {
  std::string program;
  std::string preset;  ///< inhouse or av2
};

/// One map per frame. Throws std::runtime_error where the program fails, or gives other maps than asked for.
std::vector<LocalMap> run_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames);

}  // namespace laneloom
