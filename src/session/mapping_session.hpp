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

namespace laneloom {

/// The progress of one source of detections since its session began.
struct SourceProgress {
  std::string source;
  std::uint64_t session_id = 0;
  std::uint64_t fused = 0;                       ///< frames that went into the map
  std::int64_t arrival_ns = 0;                   ///< of its newest believed frame
  std::optional<std::int64_t> fused_arrival_ns;  ///< of the one that was fused last
  std::optional<std::int64_t> fused_stamp_ns;    ///< of its newest fused frame
};

/// From poses and detection frames, in the order of their arrival, to the map: decides what is believed,
/// waits for the poses that belong to each frame, and fuses each frame with the pose at its own stamp. Frames
/// that are ready together are fused in the order of their stamps; a frame that comes later than newer ones
/// of another source is fused all the same.
///
/// It has no clock, thread or queue of its own. What it decides depends on the messages and their order
/// alone, except for expire(); so a replay of the same messages makes the same maps. Not thread-safe: one
/// thread at a time.
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
  /// Takes a frame, and fuses it when its poses are there. `arrival_ns` is by the clock of expire().
  void add(DetectionFrame frame, std::int64_t arrival_ns);
  /// Refuses the frames that have waited for their poses for too long.
  void expire(std::int64_t now_ns);
  /// From now until the next call, begins a further frame only while `may_go_on()`, after one frame at least;
  /// the others wait. There is no limit before the first call.
  void fuse_while(std::function<bool()> may_go_on);

  /// What was done since the last call.
  struct Progress {
    std::vector<FusedFrame> fused;      ///< in the order of fusion
    std::vector<LineageEvent> lineage;  ///< of all of them
    std::uint64_t resets = 0;           ///< how often the map was cleared
  };
  Progress take_progress();

  /// What the map is of: beside the mapper's state, what another session needs to go on with it.
  struct Checkpoint {
    std::int64_t frame_stamp_ns = 0;    ///< of the newest frame in the map
    std::int64_t frame_arrival_ns = 0;  ///< its arrival, by the clock of expire()
    std::int64_t pose_stamp_ns = 0;     ///< of the newest pose
    std::uint64_t pose_session_id = 0;
    Point position = Point::Zero();
  };
  /// None while nothing was fused into the map here.
  std::optional<Checkpoint> checkpoint() const;
  /// Goes on from there, with the state that its mapper had. If the first pose can't follow on the one
  /// before, the map is none of its frame, and is cleared.
  void resume(const Checkpoint& checkpoint, MapperState state);

  const LocalMap& map() const;
  Mapper& mapper();
  const Mapper& mapper() const;
  /// Frames that wait for their poses.
  std::size_t pending() const;
  /// Of these, frames whose poses are there: fuse_while() left no time for them.
  std::size_t ready() const;
  /// Arrival of the newest frame in the map; none: the map is empty.
  std::optional<std::int64_t> newest_arrival_ns() const;

  /// frames_fused, frames_thinned (of which admission left detections out), detections_left_out (those),
  /// sources_restarted, frames_dropped_queue_full, detections_refused_<reason>, poses_accepted,
  /// poses_refused_<reason>, map_resets. Every frame that was added is fused, refused, dropped or pending;
  /// every pose is accepted or refused.
  const Counters& counters() const;
  /// By source.
  std::vector<SourceProgress> sources() const;
  /// Arrival of the newest frame of a source too many, which was refused; none: never.
  std::optional<std::int64_t> crowded_out_ns() const;
  /// From the stamp of the newest fused frame to that of the newest pose; none: nothing was fused yet.
  std::optional<double> lag_s() const;

  /// Told of the stages of every fused frame; may be null.
  void observe(StageObserver* observer);
  /// Told of the map after every fused frame, where map() only shows the last one.
  void observe(std::function<void(const FusedFrame&, const LocalMap&)> observer);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace laneloom
