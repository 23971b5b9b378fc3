#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiment/drive_simulation.hpp"
#include "laneloom/messages.hpp"

namespace laneloom::experiment {

/// Another program that fuses frames as JSON lines into maps as JSON lines:
/// `PROGRAM --in F --out F --report F --preset P`.
struct Peer {
  std::string program;
  std::string preset;  ///< inhouse or av2
};

/// The peer's maps, one per frame. Throws std::runtime_error if the program fails, or gives other maps than
/// asked for.
std::vector<LocalMap> run_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames);

/// The times that the peer itself measured, per frame and without reading and writing: {"frames": n,
/// "peak_rss_mb": x, "ms": {"total": {"mean", "p50", "p99", "max"}, …one entry per stage}}.
struct PeerReport {
  std::map<std::string, TimeSummary> stages;
  TimeSummary total;
  double peak_rss_mb = 0.0;
};

/// Lets the peer fuse the frames and returns its times. Throws std::runtime_error if the program fails, or
/// has not reported on every frame.
PeerReport time_peer(const Peer& peer, const std::vector<SimulatedFrame>& frames);

}  // namespace laneloom::experiment
