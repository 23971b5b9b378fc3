#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "laneloom/dds/cdr.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/recording.hpp"
#include "recording/topics.hpp"

namespace laneloom::recording {
namespace {

constexpr std::string_view kExtension = ".mcap";

std::string without_extension(std::string path) {
  if (path.ends_with(kExtension)) path.resize(path.size() - kExtension.size());
  return path;
}

template <class Topic>
McapChannel channel_of(const Topic& topic) {
  return {topic.name, kCdr, std::make_shared<McapSchema>(McapSchema{topic.type, kOmgIdl, topic.idl})};
}

/// A time in MCAP, which knows none before 1970.
std::uint64_t mcap_time(std::int64_t time_ns) {
  return static_cast<std::uint64_t>(std::max(std::int64_t{0}, time_ns));
}

}  // namespace

class RecordingWriter::Impl {
 public:
  Impl(const std::string& path, RecordingOptions options)
      : path_(without_extension(path)), options_(std::move(options)) {
    open_next();
  }
  ~Impl() {
    try {
      close();
    } catch (const std::exception&) {  // close() reports failures
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  template <class T>
  void write(const T& message, std::int64_t log_time_ns) {
    left_out_ += dds::to_cdr(message, options_.map_frame_id, cdr_);
    write_cdr<T>(cdr_, log_time_ns);
  }

  template <class T>
  void write_cdr(ByteView message, std::int64_t log_time_ns) {
    write_cdr(kTopicIndex<T>, message, log_time_ns);
  }

  void write_cdr(std::size_t topic, ByteView message, std::int64_t log_time_ns) {
    prepare(log_time_ns);
    const auto header = dds::header_of(message);
    file_->write(channels_.at(topic), mcap_time(log_time_ns),
                 mcap_time(header ? header->stamp_ns : log_time_ns),
                 header ? static_cast<std::uint32_t>(header->sequence) : 0U, message);
  }

  void write_extra(std::size_t topic, ByteView message, std::int64_t log_time_ns) {
    prepare(log_time_ns);
    file_->write(extra_channels_.at(topic), mcap_time(log_time_ns), mcap_time(log_time_ns), 0U, message);
  }

  void flush() {
    if (file_) file_->flush();
  }
  void close() {
    if (!file_) return;
    file_->close();
    file_.reset();
  }

  const std::string& path() const { return file_path_; }
  std::uint64_t left_out() const { return left_out_; }

 private:
  static constexpr std::size_t kTopics = std::variant_size_v<AnyMessage>;
  using Channels = std::array<std::uint16_t, kTopics>;

  void prepare(std::int64_t log_time_ns) {
    if (!file_) throw std::runtime_error(path_ + ": the recording is closed");
    roll_over(log_time_ns);
  }

  bool limited() const { return options_.max_file_bytes > 0 || options_.max_file_s > 0.0; }

  std::string next_path() {
    if (!limited()) return path_ + std::string(kExtension);
    std::string number = std::to_string(files_++);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
    return path_ + "_" + number + std::string(kExtension);
  }

  template <std::size_t... index>
  static Channels add_channels(McapWriter& file, std::index_sequence<index...> /*topics*/) {
    return {file.add_channel(channel_of(topic_of<std::variant_alternative_t<index, AnyMessage>>()))...};
  }

  void open_next() {
    file_path_ = next_path();
    auto file = std::make_unique<McapWriter>(file_path_, options_.compression, options_.chunk_bytes);
    channels_ = add_channels(*file, std::make_index_sequence<kTopics>());
    extra_channels_.clear();
    for (const ExtraTopic& topic : options_.extra_topics)
      extra_channels_.push_back(file->add_channel(channel_of(topic)));
    McapMetadata origin{{kVersionKey, LANELOOM_VERSION}};
    if (!options_.configuration.empty()) origin[kConfigurationKey] = options_.configuration;
    file->write_metadata(kOriginName, origin);
    file_ = std::move(file);
    start_ns_.reset();
  }

  void roll_over(std::int64_t log_time_ns) {
    if (!start_ns_) start_ns_ = log_time_ns;
    const double elapsed_s = static_cast<double>(log_time_ns - *start_ns_) * 1e-9;
    const bool full = options_.max_file_bytes > 0 && file_->size() >= options_.max_file_bytes;
    const bool old = options_.max_file_s > 0.0 && elapsed_s >= options_.max_file_s;
    if (!full && !old) return;
    close();
    open_next();
    start_ns_ = log_time_ns;
  }

  std::string path_;  ///< path without number and extension
  RecordingOptions options_;
  std::string file_path_;
  std::unique_ptr<McapWriter> file_;
  Channels channels_{};
  std::vector<std::uint16_t> extra_channels_;  ///< in the order of options_.extra_topics
  std::optional<std::int64_t> start_ns_;       ///< log time of the file's first message
  int files_ = 0;
  Bytes cdr_;  // kept, so that its memory is reused
  std::uint64_t left_out_ = 0;
};

RecordingWriter::RecordingWriter(const std::string& path, RecordingOptions options)
    : impl_(std::make_unique<Impl>(path, std::move(options))) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

template <class T>
void RecordingWriter::write(const T& message, std::int64_t log_time_ns) {
  impl_->write(message, log_time_ns);
}
template <class T>
void RecordingWriter::write_cdr(std::span<const std::uint8_t> message, std::int64_t log_time_ns) {
  impl_->write_cdr<T>(message, log_time_ns);
}
void RecordingWriter::write_raw(const RawMessage& message) {
  impl_->write_cdr(message.topic, message.bytes, message.log_time_ns);
}
void RecordingWriter::write_extra(std::size_t topic, std::span<const std::uint8_t> message,
                                  std::int64_t log_time_ns) {
  impl_->write_extra(topic, message, log_time_ns);
}
void RecordingWriter::flush() { impl_->flush(); }
void RecordingWriter::close() { impl_->close(); }
const std::string& RecordingWriter::path() const { return impl_->path(); }
std::uint64_t RecordingWriter::left_out() const { return impl_->left_out(); }

template void RecordingWriter::write(const DetectionFrame&, std::int64_t);
template void RecordingWriter::write_cdr<DetectionFrame>(std::span<const std::uint8_t>, std::int64_t);
template void RecordingWriter::write(const VehiclePose&, std::int64_t);
template void RecordingWriter::write_cdr<VehiclePose>(std::span<const std::uint8_t>, std::int64_t);
template void RecordingWriter::write(const TrackedObjects&, std::int64_t);
template void RecordingWriter::write_cdr<TrackedObjects>(std::span<const std::uint8_t>, std::int64_t);
template void RecordingWriter::write(const NextTurn&, std::int64_t);
template void RecordingWriter::write_cdr<NextTurn>(std::span<const std::uint8_t>, std::int64_t);
template void RecordingWriter::write(const PublishedMap&, std::int64_t);
template void RecordingWriter::write_cdr<PublishedMap>(std::span<const std::uint8_t>, std::int64_t);
template void RecordingWriter::write(const RoadMarkings&, std::int64_t);
template void RecordingWriter::write_cdr<RoadMarkings>(std::span<const std::uint8_t>, std::int64_t);
template void RecordingWriter::write(const ServiceStatus&, std::int64_t);
template void RecordingWriter::write_cdr<ServiceStatus>(std::span<const std::uint8_t>, std::int64_t);

}  // namespace laneloom::recording
