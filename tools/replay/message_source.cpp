#include "replay/message_source.hpp"

#include <stdexcept>
#include <type_traits>
#include <utility>

#include "io/file_kind.hpp"
#include "io/json_lines.hpp"
#include "io/leave_out.hpp"
#include "laneloom/dds/cdr.hpp"
#include "recording/damage.hpp"

namespace laneloom::replay {
namespace {

/// Throws if something was left out, and nothing is left.
void check_rest(const std::string& path, const LeftOut& left_out, std::uint64_t count) {
  if (count > 0 || left_out.empty()) return;
  throw std::runtime_error(path + ": nothing of it can be read: " + left_out.summary());
}

class McapMessages : public MessageSource {
 public:
  McapMessages(const std::string& path, const std::string& map_frame_id, bool strict)
      : path_(path), reader_(path, map_frame_id), left_out_(strict) {}

  std::optional<recording::RecordedMessage> next() override {
    return rest([&] { return reader_.next(); });
  }
  std::optional<recording::RecordedMessage> next_input() override {
    return rest([&] { return reader_.next_input(); });
  }
  std::optional<recording::RawMessage> next_raw() override {
    return rest([&] { return reader_.next_raw(); });
  }
  double progress() const override { return reader_.progress(); }
  Counters refused() const override { return reader_.refused(); }
  const LeftOut& left_out() const override { return left_out_; }
  recording::Origin origin() const override { return reader_.origin(); }

 private:
  template <typename Next>
  std::invoke_result_t<Next> rest(Next next) {
    auto message = recording::next_or_leave_out(left_out_, next);
    if (!message) check_rest(path_, left_out_, count_);
    ++count_;
    return message;
  }

  std::string path_;
  recording::RecordingReader reader_;
  LeftOut left_out_;
  std::uint64_t count_ = 0;
};

class JsonLinesMessages : public MessageSource {
 public:
  JsonLinesMessages(const std::string& path, std::string map_frame_id, const MessageReading& reading)
      : path_(path),
        reader_(path, reading.conventions),
        map_frame_id_(map_frame_id.empty() ? "map" : std::move(map_frame_id)),
        left_out_(reading.strict) {}

  std::optional<recording::RecordedMessage> next() override {
    if (objects_) return taken(objects_);
    if (next_turn_) return taken(next_turn_);
    if (frame_) return taken(frame_);
    std::optional<io::FrameRecord> record = reader_.next_frame(left_out_);
    if (!record) {
      check_rest(path_, left_out_, count_);
      return std::nullopt;
    }
    record->pose.sequence = ++count_;  // lines have no number for it
    frame_ = std::move(record->frame);
    objects_ = std::move(record->objects);
    next_turn_ = record->next_turn;
    return recording::RecordedMessage{frame_->stamp_ns, frame_->stamp_ns, record->pose};
  }

  std::optional<recording::RecordedMessage> next_input() override { return next(); }

  std::optional<recording::RawMessage> next_raw() override {
    const std::optional<recording::RecordedMessage> message = next();
    if (!message) return std::nullopt;
    recording::RawMessage raw{message->log_time_ns, message->message.index(), {}};
    const std::size_t too_much =
        std::visit([&](const auto& m) { return dds::to_cdr(m, map_frame_id_, raw.bytes); }, message->message);
    if (too_much > 0) io::leave_out(left_out_, io::kBeyondBounds, raw.log_time_ns, too_much);
    return raw;
  }

  double progress() const override { return reader_.progress(); }
  Counters refused() const override { return {}; }
  const LeftOut& left_out() const override { return left_out_; }
  recording::Origin origin() const override { return {}; }

 private:
  template <class T>
  static recording::RecordedMessage taken(std::optional<T>& message) {
    const std::int64_t stamp_ns = message->stamp_ns;
    return {stamp_ns, stamp_ns, *std::exchange(message, std::nullopt)};
  }

  std::string path_;
  io::JsonLinesReader reader_;
  std::string map_frame_id_;
  LeftOut left_out_;
  std::uint64_t count_ = 0;                ///< of frames
  std::optional<DetectionFrame> frame_;    ///< the next message; its pose was given out before it
  std::optional<TrackedObjects> objects_;  ///< likewise, between the two
  std::optional<NextTurn> next_turn_;      ///< likewise
};

}  // namespace

std::unique_ptr<MessageSource> open_messages(const std::string& path, const std::string& map_frame_id,
                                             const MessageReading& reading) {
  if (path == io::kStandard) return std::make_unique<JsonLinesMessages>(path, map_frame_id, reading);
  if (recording::is_recording(path))
    return std::make_unique<McapMessages>(path, map_frame_id, reading.strict);
  if (const std::string kind = io::file_kind(path); !kind.empty())
    throw std::runtime_error(path + ": " + kind + "; a recording (MCAP) or frames as JSON lines are needed");
  return std::make_unique<JsonLinesMessages>(path, map_frame_id, reading);
}

}  // namespace laneloom::replay
