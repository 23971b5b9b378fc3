#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"
#include "session/gate.hpp"
#include "session/mapping_session.hpp"

namespace laneloom {

/// The sources of detections: which frames of each are believed, and what became of them. What happens to one
/// source leaves the others as they are. There is room for eight sources. A further one takes the place of
/// one of which nothing was believed for 2 s; where all go on, the further one is refused.
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
  /// Arrival of the newest frame that was refused because there was no room for its source; none: never.
  std::optional<std::int64_t> crowded_out_ns() const { return crowded_out_ns_; }

 private:
  struct Source {
    Gate gate;
    SourceProgress progress;
    std::deque<std::int64_t> stamps_ns;  ///< of the newest accepted frames
  };

  Source* find_or_add(const std::string& name, std::int64_t arrival_ns);
  bool make_room(std::int64_t arrival_ns);

  GateConfig config_;
  std::map<std::string, Source> sources_;
  std::optional<std::int64_t> crowded_out_ns_;
};

}  // namespace laneloom
