#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "session/gate.hpp"
#include "session/mapping_session.hpp"

namespace laneloom {

/// The sources of detections: which frames of each are believed, and what became of them. What happens to one
/// source leaves the others as they are. Of too many sources, the one that accepted nothing for longest is
/// forgotten.
class Sources {
 public:
  explicit Sources(const GateConfig& config) : config_(config) {}

  struct Verdict {
    std::string_view refusal;  ///< a stable name; empty: the frame is believed
    bool restarted = false;    ///< the source begins anew with this frame
  };
  /// Frames of one source may come in another order than that of their stamps.
  Verdict check(const DetectionFrame& frame, std::int64_t arrival_ns);
  /// The frame went into the map.
  void note_fused(const DetectionFrame& frame, std::int64_t arrival_ns);

  /// By name.
  std::vector<SourceProgress> progress() const;

 private:
  struct Source {
    Gate gate;
    SourceProgress progress;
    std::deque<std::int64_t> stamps_ns;  ///< of the newest accepted frames
    std::uint64_t accepted = 0;          ///< number of its newest accepted frame, among those of all sources
  };

  void forget_idle();

  GateConfig config_;
  std::map<std::string, Source> sources_;
  std::uint64_t accepted_ = 0;
};

}  // namespace laneloom
