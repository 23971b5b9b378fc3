#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "laneloom/config.hpp"
#include "recording/recording.hpp"
#include "replay/map_output.hpp"
#include "session/mapping_session.hpp"

namespace laneloom::replay {

/// Takes a map as the service would publish it.
using MapTaker = std::function<void(PublishedMap map, std::int64_t log_time_ns)>;

/// Processes recorded messages as the service did when they arrived, and gives one map per fused frame. The
/// log times are its clock. Not thread-safe.
class Replay {
 public:
  /// `config` must be valid. `observer` may be null.
  Replay(const Config& config, MapTaker take_map, StageObserver* observer = nullptr);

  void add(recording::RecordedMessage message);

  const Counters& counters() const { return session_.counters(); }
  std::size_t pending() const { return session_.pending(); }
  /// The values that were learned of each source's network.
  NetworkProfiles networks() const { return session_.mapper().profiles(); }

 private:
  void publish(const FusedFrame& fused, const LocalMap& map);

  std::string map_frame_id_;
  session::MappingSession session_;
  MapTaker take_map_;
  std::int64_t now_ns_ = 0;
  std::uint64_t maps_ = 0;
};

/// A hash of a replay's maps, with their markings, as they go over the wire. The times of arrival are left
/// out. Not thread-safe.
class MapHash {
 public:
  void add(PublishedMap map);
  std::string text() const { return digest_.text(); }

 private:
  Digest digest_;
  std::vector<std::uint8_t> cdr_;  // kept, so that its memory is reused
};

/// Compares maps that the live service published with those of a replay, by their stamps. Fields of the
/// publication are left out: sequence, session, age, state, and the lineage, which covers all frames since
/// the map before.
class LiveComparison {
 public:
  void add_live(const PublishedMap& map);
  void add_live(const RoadMarkings& markings);
  void add_replayed(const PublishedMap& map);

  struct Result {
    std::size_t equal = 0, different = 0, missing = 0;  ///< of the live messages
    bool began_late = false;  ///< the service had fused frames before those that were recorded
    bool holds() const { return equal > 0 && different == 0 && missing == 0; }
  };
  Result result() const;

 private:
  using Digests = std::map<std::int64_t, std::string>;  ///< by stamp
  Digests live_maps_, live_markings_, maps_, markings_;
};

}  // namespace laneloom::replay
