#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/counters.hpp"
#include "laneloom/mapper.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "session/source_agreement.hpp"

namespace laneloom::session {

/// The longest period of a source that is told from silence.
inline constexpr std::int64_t kLongestPeriod_ns = 2'000'000'000;

/// The progress of one source of detections since its session began.
struct SourceProgress {
  std::string source;                            ///< the name that its frames carry
  std::uint64_t session_id = 0;                  ///< of its run
  std::uint64_t fused = 0;                       ///< number of frames that went into the map
  std::int64_t arrival_ns = 0;                   ///< of its newest believed frame
  std::int64_t period_ns = kLongestPeriod_ns;    ///< from the arrival before to that one, if it is shorter
  std::optional<std::int64_t> fused_arrival_ns;  ///< of the frame that was fused last
  std::optional<std::int64_t> fused_stamp_ns;    ///< of its newest fused frame
};

/// Makes the map from poses and detection frames, in the order of their arrival. It decides which messages
/// are believed, waits for the poses that belong to each frame, and fuses each frame with the pose at its own
/// stamp. Frames that are ready together are fused in the order of their stamps; a frame that comes later
/// than newer ones of another source is fused all the same.
///
/// It has no clock, thread or queue of its own. Its maps depend on the messages and their order alone, except
/// for expire() and fuse_while(), so that a replay of the same messages makes the same maps. Not thread-safe:
/// one thread at a time.
class MappingSession {
 public:
  /// `config` must be valid; its parts mapper, sd_map, sync and gate are used. Throws as
  /// load_sd_map(), load_network_profiles() and Mapper().
  explicit MappingSession(const Config& config);
  ~MappingSession();
  MappingSession(MappingSession&&) noexcept;
  MappingSession& operator=(MappingSession&&) noexcept;

  /// Takes a pose, and fuses the frames that waited for it.
  void add(const VehiclePose& pose);
  /// Takes a frame, and fuses it once its poses are there. `arrival_ns` is by the same clock as expire().
  void add(DetectionFrame frame, std::int64_t arrival_ns);
  /// Takes objects. They go into the map with the next fused frame that is not older than they are.
  void add(TrackedObjects objects);
  /// Takes the next turn of the route. It leads the way of the frames that are fused from then on and not
  /// older.
  void add(NextTurn turn);
  /// Refuses the frames that have waited for their poses for too long.
  void expire(std::int64_t now_ns);
  /// Limits the fusion from now until the next call: after the first frame, a further one is begun only while
  /// `may_go_on()`. The other frames wait. There is no limit before the first call.
  void fuse_while(std::function<bool()> may_go_on);

  /// The progress since the last call.
  struct Progress {
    std::vector<FusedFrame> fused;      ///< in the order of fusion
    std::vector<LineageEvent> lineage;  ///< of all these frames
    std::uint64_t resets = 0;           ///< number of times that the map was cleared
    std::uint64_t pose_jumps = 0;       ///< see Mapper::poses_jumped()
  };
  Progress take_progress();

  /// The newest inputs of the map. Another session needs them, beside the mapper's state, to go on with the
  /// map.
  struct Checkpoint {
    std::int64_t frame_stamp_ns = 0;    ///< of the newest frame in the map
    std::int64_t frame_arrival_ns = 0;  ///< its arrival, by the clock of expire()
    std::int64_t pose_stamp_ns = 0;     ///< of the newest pose
    std::uint64_t pose_session_id = 0;  ///< of the newest pose
    Point position = Point::Zero();     ///< of the newest pose, map frame
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< of the newest pose

    template <class Archive>
    void serialize(Archive& archive) {
      archive(frame_stamp_ns, frame_arrival_ns, pose_stamp_ns, pose_session_id, position.x(), position.y(),
              position.z(), orientation.w(), orientation.x(), orientation.y(), orientation.z());
    }
  };
  /// The checkpoint of the present map. None: this session has not yet fused a frame into it.
  std::optional<Checkpoint> checkpoint() const;
  /// Goes on from a checkpoint, with the state that the mapper had there. If the first pose can not follow
  /// the checkpoint's pose, the map is cleared.
  void resume(const Checkpoint& checkpoint, MapperState state);
  /// The state of the mapper, which goes with the checkpoint.
  const MapperState& mapper_state() const;

  const LocalMap& map() const;
  Mapper& mapper();
  const Mapper& mapper() const;
  /// Number of frames that wait to be fused.
  std::size_t pending() const;
  /// Number of waiting frames whose poses are there: fuse_while() left no time for them.
  std::size_t ready() const;
  /// Arrival of the frame that was fused last. None: the map is empty.
  std::optional<std::int64_t> newest_arrival_ns() const;

  /// The counters frames_fused, frames_thinned (frames of which admission left detections out),
  /// detections_left_out (these detections), detections_zigzagging and detections_unsure (left out by the
  /// mapper), lines_forgotten, sources_restarted, frames_dropped_queue_full, detections_refused_<reason>,
  /// poses_accepted, poses_refused_<reason>, objects_fused, objects_dropped_queue_full,
  /// objects_refused_<reason>, objects_believed, objects_without_heading and objects_doubted
  /// (trails::MovingObjects), next_turns_fused, next_turns_dropped_queue_full, next_turns_refused_<reason>,
  /// map_resets, pose_jumps. Every frame that was added is fused, refused, dropped or pending, and so is
  /// every message of objects and turns; every pose is accepted or refused.
  const Counters& counters() const;
  /// The progress of all sources, by name.
  std::vector<SourceProgress> sources() const;
  /// The sources that contradict others. Their frames are refused meanwhile.
  std::vector<Disagreement> disagreements() const;
  /// Arrival of the newest frame that was refused because there were too many sources. None: never.
  std::optional<std::int64_t> crowded_out_ns() const;
  /// Seconds from the stamp of the newest fused frame to that of the newest pose. None: nothing was fused
  /// yet.
  std::optional<double> lag_s() const;

  /// Lets `observer` be told of the stages of every fused frame. It may be null.
  void observe(StageObserver* observer);
  /// Lets `observer` be told of the map after every fused frame; map() only shows the last one.
  void observe(std::function<void(const FusedFrame&, const LocalMap&)> observer);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace laneloom::session
