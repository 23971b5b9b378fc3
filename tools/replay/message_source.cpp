#include "replay/message_source.hpp"

#include <array>
#include <fstream>
#include <utility>

#include "io/json_lines.hpp"
#include "laneloom/dds/cdr.hpp"

namespace laneloom::replay {
namespace {

class McapMessages : public MessageSource {
 public:
  McapMessages(const std::string& path, const std::string& map_frame_id) : reader_(path, map_frame_id) {}

  std::optional<recording::RecordedMessage> next() override { return reader_.next(); }
  std::optional<recording::RecordedMessage> next_input() override { return reader_.next_input(); }
  std::optional<recording::RawMessage> next_raw() override { return reader_.next_raw(); }
  double progress() const override { return reader_.progress(); }
  Counters refused() const override { return reader_.refused(); }
  bool cut_off() const override { return reader_.cut_off(); }

 private:
  recording::RecordingReader reader_;
};

class JsonLinesMessages : public MessageSource {
 public:
  JsonLinesMessages(const std::string& path, std::string map_frame_id)
      : reader_(path), map_frame_id_(std::move(map_frame_id)) {}

  std::optional<recording::RecordedMessage> next() override {
    if (frame_) {
      const std::int64_t stamp_ns = frame_->stamp_ns;
      return recording::RecordedMessage{stamp_ns, stamp_ns, *std::exchange(frame_, std::nullopt)};
    }
    std::optional<io::FrameRecord> record = reader_.next_frame();
    if (!record) return std::nullopt;
    frame_ = std::move(record->frame);
    return recording::RecordedMessage{frame_->stamp_ns, frame_->stamp_ns, record->pose};
  }

  std::optional<recording::RecordedMessage> next_input() override { return next(); }

  std::optional<recording::RawMessage> next_raw() override {
    const std::optional<recording::RecordedMessage> message = next();
    if (!message) return std::nullopt;
    recording::RawMessage raw{message->log_time_ns, message->message.index(), {}};
    std::visit([&](const auto& m) { dds::to_cdr(m, map_frame_id_, raw.bytes); }, message->message);
    return raw;
  }

  double progress() const override { return reader_.progress(); }
  Counters refused() const override { return {}; }
  bool cut_off() const override { return false; }

 private:
  io::JsonLinesReader reader_;
  std::string map_frame_id_;
  std::optional<DetectionFrame> frame_;  ///< the next message; its pose was given out before it
};

}  // namespace

std::unique_ptr<MessageSource> open_messages(const std::string& path, const std::string& map_frame_id) {
  if (recording::is_recording(path)) return std::make_unique<McapMessages>(path, map_frame_id);
  return std::make_unique<JsonLinesMessages>(path, map_frame_id);
}

}  // namespace laneloom::replay
