#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

namespace laneloom {

/// A message's place in its stream.
struct StreamPoint {
  std::int64_t stamp_ns = 0;
  std::uint64_t session_id = 0;
  Point position = Point::Zero();  ///< of a pose; zero in streams that have none
};

/// Decides which messages of one stream are believed. A jump of stamp or position is an outlier; the third
/// one in a row that agrees with its predecessors is believed, and so is the first of a new session: with
/// them the stream begins anew.
class Gate {
 public:
  enum class Verdict {
    accepted,
    begins_anew,  ///< accepted, but it has nothing to do with what came before
    repeated,     ///< of the stamp that was accepted last
    late,         ///< older, within a plausible step
    outlier
  };

  explicit Gate(const GateConfig& config) : config_(config) {}

  Verdict check(const StreamPoint& point);

 private:
  bool plausible(const StreamPoint& from, const StreamPoint& to) const;
  bool is_superseded(std::uint64_t session_id) const;
  Verdict check_outlier(const StreamPoint& point);
  Verdict begin_anew(const StreamPoint& point);

  GateConfig config_;
  std::optional<StreamPoint> last_;     ///< accepted
  std::optional<StreamPoint> outlier_;  ///< the newest
  int outliers_in_a_row_ = 0;
  /// Sessions that a newer one took the place of. A second writer that is still alive (two perception stacks
  /// by mistake) can't take it back with a single message.
  std::deque<std::uint64_t> superseded_;
};

/// Why a message is refused whatever came before it, as a stable name; empty: it is not.
std::string_view defect(const DetectionFrame& frame, const GateConfig& config);
std::string_view defect(const VehiclePose& pose, const GateConfig& config);

}  // namespace laneloom
