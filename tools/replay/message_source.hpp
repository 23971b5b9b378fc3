#pragma once

#include <memory>
#include <optional>
#include <string>

#include "recording/recording.hpp"

namespace laneloom {

/// The messages of a drive, in the order of their arrival. Not thread-safe.
class MessageSource {
 public:
  virtual ~MessageSource() = default;

  /// None: the end. Throws std::runtime_error naming file and place of what is malformed.
  virtual std::optional<RecordedMessage> next() = 0;
  /// The next detections or pose; what a service published is passed over unread.
  virtual std::optional<RecordedMessage> next_input() = 0;
  /// The next one as it goes over the wire.
  virtual std::optional<RawMessage> next_raw() = 0;
  /// How much was read, from 0 to 1.
  virtual double progress() const = 0;
  /// Messages that were passed over so far, as "<topic>: <reason>".
  virtual Counters refused() const = 0;
  /// The file ends before its end.
  virtual bool cut_off() const = 0;
};

/// Opens a recording (MCAP), or frames with their poses as JSON lines (io/json_lines.hpp): the first bytes
/// tell which. Of a line come the pose, then the frame, both at the frame's stamp. `map_frame_id` is the
/// frame of the poses. Throws std::runtime_error where the file cannot be read.
std::unique_ptr<MessageSource> open_messages(const std::string& path, const std::string& map_frame_id);

}  // namespace laneloom
