#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "laneloom/dds/raw_writer.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "recording/recording.hpp"
#include "replay/message_source.hpp"

namespace laneloom::replay {

/// The topics that a drive may do without.
struct OptionalTopics {
  bool objects = false, next_turns = false;
};

/// The optional topics of which the rest of a source has messages. Reads up to the first message of each.
OptionalTopics optional_topics(MessageSource& source);

/// Publishes recorded detections, poses, objects and turns again, byte for byte, as their participants did.
/// Not thread-safe.
class Player {
 public:
  /// `speed_up`: recorded seconds per second. `topics`: those of which there will be messages; others are not
  /// announced, and their messages are passed over. Throws std::runtime_error where DDS refuses.
  Player(const DdsConfig& dds, double speed_up, const OptionalTopics& topics);

  /// Number of readers, of detections or poses, whichever has fewer.
  int readers() const { return std::min(detections_.matched(), poses_.matched()); }

  /// The time at which a message is due. The first one is due now, the others as long after it as they were
  /// recorded, divided by `speed_up`.
  std::chrono::steady_clock::time_point due(const recording::RawMessage& message);
  /// Publishes a message. Messages of other topics than the inputs are passed over.
  void publish(const recording::RawMessage& message);

  std::uint64_t detections() const { return detections_published_; }
  std::uint64_t poses() const { return poses_published_; }
  std::uint64_t not_taken() const { return not_taken_; }  ///< number of messages that DDS did not take

 private:
  dds::Participant participant_;
  std::optional<dds::RawWriter<TrackedObjects>> objects_;  ///< none: there will be no messages
  std::optional<dds::RawWriter<NextTurn>> next_turns_;     ///< likewise
  dds::RawWriter<DetectionFrame> detections_;
  dds::RawWriter<VehiclePose> poses_;
  double speed_up_;
  std::optional<std::int64_t> first_ns_;
  std::chrono::steady_clock::time_point start_;
  std::uint64_t detections_published_ = 0, poses_published_ = 0, not_taken_ = 0;
};

}  // namespace laneloom::replay
