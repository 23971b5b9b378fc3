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

namespace laneloom::session {

/// Decides which frames of each source of detections are believed, and keeps the sources' progress. No source
/// affects another one. There is room for eight sources. A further source takes the place of one of which
/// nothing was believed for 2 s. If there is no such one, the further source is refused.
class Sources {
 public:
  explicit Sources(const GateConfig& config) : config_(config) {}

  /// The judgement of a frame.
  struct Verdict {
    std::string_view refusal;  ///< a stable name; empty: the frame is believed
    bool restarted = false;    ///< a new session of the source begins with this frame
  };
  /// Judges a frame. Frames of one source may come in another order than that of their stamps.
  Verdict check(const DetectionFrame& frame, std::int64_t arrival_ns);
  /// Notes that a frame went into the map.
  void note_fused(const DetectionFrame& frame, std::int64_t arrival_ns);

  /// The progress of all sources, by name.
  std::vector<SourceProgress> progress() const;
  /// Arrival of the newest frame that was refused because there was no room for its source. None: never.
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

}  // namespace laneloom::session
