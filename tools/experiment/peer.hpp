#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"
#include "laneloom/messages.hpp"

namespace laneloom {

/// Another program that fuses frames as JSON lines into maps as JSON lines:
/// `PROGRAM --in F --out F --report F --preset P`.
struct Peer {
  std::string program;
  std::string preset;  ///< inhouse or av2
};

/// One map per frame. Throws std::runtime_error where the program fails, or gives other maps than asked for.
std::vector<LocalMap> run_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames);

/// What the peer itself measured, per frame and without reading and writing:
/// {"frames": n, "peak_rss_mb": x, "ms": {"total": {"mean", "p50", "p99", "max"}, …one entry per stage}}.
struct PeerReport {
  std::map<std::string, TimeSummary> stages;
  TimeSummary total;
  double peak_rss_mb = 0.0;
};

/// Throws std::runtime_error where the program fails, or has not reported on every frame.
PeerReport time_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames);

}  // namespace laneloom
