#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string_view>

#include "laneloom/config.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

namespace laneloom::session {

/// A message's place in its stream.
struct StreamPoint {
  std::int64_t stamp_ns = 0;     ///< sensor clock
  std::uint64_t session_id = 0;  ///< of the writer's run
  /// The pose's position in the map frame. A stream of detections has zero here.
  Point position = Point::Zero();
  /// The pose's orientation in the map frame. A stream of detections has the identity here.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Whether a point may follow another one of its stream, at most `max_step_s` later: in the same session, and
/// at a place and an orientation that the vehicle can have reached.
bool follows(const StreamPoint& point, const StreamPoint& before, const GateConfig& config,
             double max_step_s);

/// Decides which messages of one stream are believed. A message that jumps in stamp, position or orientation
/// is an outlier. The third outlier in a row that agrees with its predecessors is believed, and so is the
/// first message of a new session: the stream begins anew with it. A message whose stamp is wrong by less
/// than a jump is believed until the messages after it show that it was wrong.
class Gate {
 public:
  enum class Verdict {
    accepted,
    begins_anew,  ///< accepted; it does not continue the messages before
    corrects,     ///< accepted; the accepted messages with newer stamps were wrong
    repeated,     ///< has the stamp that was accepted last
    late,         ///< older than that, by a plausible step
    outlier       ///< jumps in stamp, position or orientation
  };

  /// If `late_anew`, late messages are also believed that follow one another for 0.2 s, with no newer message
  /// in between. If they continue the stream as it was before the newest message, that message was wrong.
  /// Otherwise the clock was set back, and the stream begins anew.
  explicit Gate(const GateConfig& config, bool late_anew = false) : config_(config), late_anew_(late_anew) {}

  Verdict check(const StreamPoint& point);

 private:
  bool plausible(const StreamPoint& from, const StreamPoint& to) const;
  bool is_superseded(std::uint64_t session_id) const;
  Verdict check_late(const StreamPoint& point);
  Verdict check_outlier(const StreamPoint& point);
  Verdict begin_anew(const StreamPoint& point);

  GateConfig config_;
  bool late_anew_;
  std::optional<StreamPoint> first_late_, late_;  ///< the first and the newest of late messages in a row
  std::optional<StreamPoint> last_;               ///< of the newest accepted message
  std::optional<StreamPoint> before_last_;        ///< of the one before, after which nothing was late
  std::optional<StreamPoint> outlier_;            ///< of the newest outlier
  int outliers_in_a_row_ = 0;
  /// Sessions that newer ones took the place of. If their writer is still alive (two perception stacks by
  /// mistake), it can not take its place back with a single message.
  std::deque<std::uint64_t> superseded_;
};

/// The reason, as a stable name, to refuse a message whatever came before it. Empty: there is none.
std::string_view defect(const DetectionFrame& frame, const GateConfig& config);
std::string_view defect(const VehiclePose& pose, const GateConfig& config);
std::string_view defect(const TrackedObjects& objects, const GateConfig& config);
std::string_view defect(const NextTurn& turn, const GateConfig& config);

}  // namespace laneloom::session
