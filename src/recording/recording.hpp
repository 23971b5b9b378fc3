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
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"
#include "laneloom/types.hpp"

/// Recordings of laneloom's topics: MCAP files (mcap.dev) with messages in CDR, as they go over the wire, and
/// the IDL that describes them.
namespace laneloom::recording {

enum class Compression : std::uint8_t { none, lz4, zstd };

/// A topic that is not laneloom's own, with messages in CDR. RecordingReader passes over topics of Foxglove's
/// types, since they are made from the other topics.
struct ExtraTopic {
  std::string name;
  std::string type;  ///< name of the message type
  std::string idl;   ///< of the type, as one text
};

/// The bytes of a recorded message, which need not be well formed.
struct RawMessage {
  std::int64_t log_time_ns = 0;  ///< time of reception, system clock
  std::size_t topic = 0;         ///< index of its type in AnyMessage
  std::vector<std::uint8_t> bytes;
};

/// How a recording is written.
struct RecordingOptions {
  Compression compression = Compression::zstd;
  std::size_t chunk_bytes = 1U << 20U;  ///< size of a chunk, which is compressed as one, before compression
  std::uint64_t max_file_bytes = 0;     ///< about; a larger file is ended and a new one begun. 0: no limit
  double max_file_s = 0.0;              ///< span of log times of one file, likewise
  std::string map_frame_id = "map";     ///< the frame that poses are in
  std::string
      configuration;  ///< of the mapper that made the maps (YAML); empty: not known, or there are none
  std::vector<ExtraTopic> extra_topics;
};

/// Writes a recording. Messages that flush() or a full chunk put on disk stay readable even if the process is
/// killed or the disk gets full. Not thread-safe. All throw std::runtime_error naming the file; after that
/// nothing more is written.
class RecordingWriter {
 public:
  /// Without limits the file is `<path>.mcap`; with limits the files are `<path>_0000.mcap`,
  /// `<path>_0001.mcap`, … No such file may exist yet. An ending `.mcap` of `path` is removed first.
  explicit RecordingWriter(const std::string& path, RecordingOptions options = {});
  RecordingWriter(RecordingWriter&&) noexcept;
  RecordingWriter& operator=(RecordingWriter&&) noexcept;
  /// Closes the file. Failures are swallowed; close() reports them.
  ~RecordingWriter();

  /// Writes a message. T is DetectionFrame, VehiclePose, TrackedObjects, NextTurn, PublishedMap,
  /// RoadMarkings or ServiceStatus. `log_time_ns` is the time of its reception, by the system clock. Its
  /// stamp is recorded as its publish time.
  template <class T>
  void write(const T& message, std::int64_t log_time_ns);
  /// Writes a message of T's topic as CDR (laneloom/dds/cdr.hpp), which need not be well formed.
  template <class T>
  void write_cdr(std::span<const std::uint8_t> message, std::int64_t log_time_ns);
  /// Writes a message of any topic of laneloom, as write_cdr().
  void write_raw(const RawMessage& message);
  /// Writes a message of `extra_topics[topic]`, as CDR.
  void write_extra(std::size_t topic, std::span<const std::uint8_t> message, std::int64_t log_time_ns);

  /// Puts all messages written so far on disk.
  void flush();
  /// Finishes the file; nothing can be written after it.
  void close();

  /// The file that is written now.
  const std::string& path() const;
  /// Number of elements of messages that were left out, because they exceed the bounds of the IDL.
  std::uint64_t left_out() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The memory that a reader may take. A file that needs more is refused.
struct RecordingLimits {
  std::uint64_t max_chunk_bytes = 256U << 20U;  ///< of one chunk, compressed or not
  std::uint64_t max_open_bytes = 1U << 30U;     ///< of all chunks whose times overlap
};

using AnyMessage = std::variant<DetectionFrame, VehiclePose, PublishedMap, RoadMarkings, ServiceStatus,
                                TrackedObjects, NextTurn>;

/// A message of a recording.
struct RecordedMessage {
  std::int64_t log_time_ns = 0;      ///< time of reception, system clock
  std::int64_t publish_time_ns = 0;  ///< its stamp
  AnyMessage message;
};

/// What a recording says of how it was made. Empty texts: it does not tell.
struct Origin {
  std::string version;        ///< of laneloom, which wrote it
  std::string configuration;  ///< of the mapper that made the maps (YAML)
};

/// Whether the file begins as MCAP does. False if it cannot be read; a later opening tells why.
/// Throws std::runtime_error for a pipe, whose beginning can be read only once.
bool is_recording(const std::string& path);

/// Reads a recording: any MCAP file of any writer, whole or cut off. Memory stays within the limits. Not
/// thread-safe. All throw std::runtime_error naming file and offset when the file is malformed; next() may
/// then be called again, and goes on behind the damage. A file that is cut off, as when its writer was
/// killed, is read up to its last whole chunk; that its end is missing is told there, once.
class RecordingReader {
 public:
  /// Messages are refused for the same reasons as by a service whose map frame is `map_frame_id`; empty: that
  /// of the first pose.
  explicit RecordingReader(const std::string& path, std::string map_frame_id = {},
                           const RecordingLimits& limits = {});
  RecordingReader(RecordingReader&&) noexcept;
  RecordingReader& operator=(RecordingReader&&) noexcept;
  ~RecordingReader();

  /// The next message in the order of log times. Messages of equal log times keep the order of the file.
  /// None: the end.
  std::optional<RecordedMessage> next();
  /// The next detections, pose, objects or turn. Messages that the service published are passed over unread.
  std::optional<RecordedMessage> next_input();
  /// The next message of a topic with the name and type of one of laneloom's, without a look into its bytes.
  std::optional<RawMessage> next_raw();

  /// How the recording was made.
  Origin origin() const;
  /// Counts of the messages that were refused so far, by "<topic>: <reason>".
  const Counters& refused() const;
  /// The share of the file that was read, 0..1.
  double progress() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace laneloom::recording
