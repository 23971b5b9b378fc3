#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "laneloom/counters.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/types.hpp"

/// Recordings of laneloom's topics: MCAP files (mcap.dev) with messages in CDR, as they go over the wire, and
/// the IDL that describes them.
namespace laneloom {

enum class Compression : std::uint8_t { none, lz4, zstd };

/// A topic that is not laneloom's own, with messages in CDR. RecordingReader passes over those whose type is
/// Foxglove's, as they are made from the others.
struct ExtraTopic {
  std::string name;
  std::string type;
  std::string idl;  ///< of the type, as one text
};

/// A message as it was recorded, which need not be well formed.
struct RawMessage {
  std::int64_t log_time_ns = 0;
  std::size_t topic = 0;  ///< index of its type in AnyMessage
  std::vector<std::uint8_t> bytes;
};

struct RecordingOptions {
  Compression compression = Compression::zstd;
  std::size_t chunk_bytes = 1U << 20U;  ///< messages that are compressed together, before compression
  std::uint64_t max_file_bytes = 0;     ///< about; a new file is begun then. 0: never
  double max_file_s = 0.0;              ///< by log time; likewise
  std::string map_frame_id = "map";     ///< of the poses
  std::vector<ExtraTopic> extra_topics;
};

/// Writes a recording. What flush() or a full chunk put on disk stays readable whatever happens later: the
/// process is killed, the disk is full. Not thread-safe. All throw std::runtime_error naming the file; after
/// that nothing more is written.
class RecordingWriter {
 public:
  /// Without limits the file is `<path>.mcap`; with limits they are `<path>_0000.mcap`, `<path>_0001.mcap`, …
  /// None may exist yet. An ending `.mcap` of `path` is of no account.
  explicit RecordingWriter(const std::string& path, RecordingOptions options = {});
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  /// Closes the file, but can't tell of failure.
  ~RecordingWriter();

  /// T is DetectionFrame, VehiclePose, PublishedMap, RoadMarkings or ServiceStatus. `log_time_ns` is when it
  /// was received, by the system clock; its publish time is its stamp.
  template <class T>
  void write(const T& message, std::int64_t log_time_ns);
  /// A message of T's topic as CDR (laneloom/dds/cdr.hpp), which need not be well formed.
  template <class T>
  void write_cdr(std::span<const std::uint8_t> message, std::int64_t log_time_ns);
  /// Of any topic, as write_cdr().
  void write_raw(const RawMessage& message);
  /// A message of `extra_topics[topic]`, as CDR.
  void write_extra(std::size_t topic, std::span<const std::uint8_t> message, std::int64_t log_time_ns);

  /// Puts what was written on disk.
  void flush();
  /// Finishes the file; nothing can be written after it.
  void close();

  /// The file that is written now.
  const std::string& path() const;
  /// Elements of messages that were left out, as they exceed the bounds of the IDL.
  std::uint64_t left_out() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a reader may take; a file that claims more is refused.
struct RecordingLimits {
  std::uint64_t max_chunk_bytes = 256U << 20U;  ///< of one chunk, compressed or not
  std::uint64_t max_open_bytes = 1U << 30U;     ///< of all chunks whose times overlap
};

using AnyMessage = std::variant<DetectionFrame, VehiclePose, PublishedMap, RoadMarkings, ServiceStatus>;

struct RecordedMessage {
  std::int64_t log_time_ns = 0;
  std::int64_t publish_time_ns = 0;
  AnyMessage message;
};

/// Whether the file begins as MCAP does. Not so one that cannot be read: whoever opens it says why.
bool is_recording(const std::string& path);

/// Reads a recording: any MCAP file, whoever wrote it, whole or cut off. Memory stays within the limits.
/// Not thread-safe. All throw std::runtime_error naming file and offset when the file is malformed; next()
/// may then be called again, and goes on behind what is damaged.
class RecordingReader {
 public:
  /// A message is refused for the reasons that a service would refuse it, whose map frame is `map_frame_id`.
  explicit RecordingReader(const std::string& path, std::string map_frame_id = "map",
                           const RecordingLimits& limits = {});
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;
  ~RecordingReader();

  /// The next message in the order of log times (of equal ones: in the order of the file). None: the end.
  std::optional<RecordedMessage> next();
  /// The next detections or pose: what the service published is passed over unread.
  std::optional<RecordedMessage> next_input();
  /// Like next(), without a look into the message: of any that has the name and type of a topic of laneloom.
  std::optional<RawMessage> next_raw();

  /// Messages that were passed over so far, as "<topic>: <reason>".
  const Counters& refused() const;
  /// The file ends before its end, as when its writer was killed: its last whole chunk is the last there is.
  bool cut_off() const;
  /// How much of the file was read, from 0 to 1.
  double progress() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom
