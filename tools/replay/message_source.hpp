#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/left_out.hpp"
#include "io/json_lines.hpp"
#include "recording/recording.hpp"

namespace laneloom::replay {

/// The messages of a drive, in the order of their arrival. Not thread-safe.
class MessageSource {
 public:
  virtual ~MessageSource() = default;

  /// The next message. None: the end. What is wrong is left out. Throws std::runtime_error naming the file if
  /// nothing is left, and naming the place of the first thing that is wrong if the source is strict.
  virtual std::optional<recording::RecordedMessage> next() = 0;
  /// The next detections or pose. Messages that a service published are passed over unread.
  virtual std::optional<recording::RecordedMessage> next_input() = 0;
  /// The next message, as it goes over the wire.
  virtual std::optional<recording::RawMessage> next_raw() = 0;
  /// The share that was read, 0..1.
  virtual double progress() const = 0;
  /// Counts of the messages that were refused so far, by "<topic>: <reason>".
  virtual Counters refused() const = 0;
  /// What was left out so far: damaged parts of a recording, or lines that are no frames.
  virtual const LeftOut& left_out() const = 0;
  /// How a recording was made. JSON lines do not tell.
  virtual recording::Origin origin() const = 0;
};

/// How messages are read.
struct MessageReading {
  bool strict = false;                 ///< the first thing that is wrong is an error
  io::FrameConventions conventions{};  ///< of JSON lines; a recording has laneloom's
};

/// Opens a recording (MCAP), or frames with their poses as JSON lines (io/json_lines.hpp); the first bytes
/// tell which. "-" is standard input, with JSON lines. A line gives the pose and then the frame, both at the
/// frame's stamp. `map_frame_id` is the frame of the poses; empty: that of a recording's first pose, and
/// "map" of JSON lines. Throws std::runtime_error if the file cannot be read, or is of another kind.
std::unique_ptr<MessageSource> open_messages(const std::string& path, const std::string& map_frame_id,
                                             const MessageReading& reading = {});

}  // namespace laneloom::replay
