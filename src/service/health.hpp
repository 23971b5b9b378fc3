#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/messages.hpp"

namespace laneloom {

/// When things came last, by the steady clock; none: never.
struct Arrivals {
  std::optional<std::int64_t> detections_ns;
  std::optional<std::int64_t> poses_ns;
  std::optional<std::int64_t> fused_ns;          ///< arrival of the newest frame in the map
  std::optional<std::int64_t> other_service_ns;  ///< a status of another service of this vehicle
  std::optional<double> lag_s;    ///< of the newest fused frame's stamp behind the newest pose's
  bool source_not_fused = false;  ///< a source of several, that was heard a moment ago
};

struct Verdict {
  MapState state = MapState::stale;
  std::vector<StateReason> reasons;  ///< empty where the state is OK
  bool operator==(const Verdict&) const = default;
};

/// Judges how far the map can be relied on. STALE: nothing was fused for stale_after_s. DEGRADED: input is
/// missing, or something went wrong within the last second. Times are the steady clock's; the lag is by
/// stamps, which are the sensors'.
class Health {
 public:
  explicit Health(ServiceConfig config) : config_(std::move(config)) {}

  void note_reset(std::int64_t now_ns) { reset_ns_ = now_ns; }
  void note_unsynchronised(std::int64_t now_ns) { unsynchronised_ns_ = now_ns; }
  void note_overload(std::int64_t now_ns) { overload_ns_ = now_ns; }

  Verdict assess(std::int64_t now_ns, const Arrivals& arrivals) const;

 private:
  ServiceConfig config_;
  std::optional<std::int64_t> reset_ns_;
  std::optional<std::int64_t> unsynchronised_ns_;
  std::optional<std::int64_t> overload_ns_;
};

/// Seconds since an arrival; -1: never.
double age_s(std::int64_t now_ns, const std::optional<std::int64_t>& arrival_ns);

}  // namespace laneloom
