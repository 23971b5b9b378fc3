#include "bench/guard_load.hpp"

#include <algorithm>
#include <string_view>

namespace laneloom::bench {
namespace {

constexpr std::size_t kPoseBytes = 400, kPoses = 100, kFrames = 10;
constexpr std::uint8_t kHeartbeat = 0x07, kData = 0x15, kDataFragments = 0x16, kHasPayload = 0x04;

/// Writes numbers as RTPS has them, the lowest byte first.
class Writer {
 public:
  Writer& number(std::size_t value, int bytes) {
    for (int i = 0; i < bytes; ++i, value >>= 8U) bytes_.push_back(static_cast<std::uint8_t>(value));
    return *this;
  }
  Writer& zeros(std::size_t count) {
    bytes_.insert(bytes_.end(), count, 0);
    return *this;
  }
  Writer& bytes(const Datagram& more) {
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    return *this;
  }
  /// A sequence number: its upper half comes first.
  Writer& sequence(std::size_t value) { return number(0, 4).number(value, 4); }
  Datagram take() const { return bytes_; }

 private:
  Datagram bytes_;
};

Datagram datagram(std::uint8_t kind, std::uint8_t flags, const Datagram& body) {
  Writer header;
  for (const char c : std::string_view("RTPS\2\3\1\17")) header.number(static_cast<std::uint8_t>(c), 1);
  const std::size_t length = body.size() > 0xffff ? 0 : body.size();  // 0: to the end of the datagram
  return header.zeros(12).number(kind, 1).number(flags | 1U, 1).number(length, 2).bytes(body).take();
}

/// What data and fragments begin with. `writer` is an entity of a participant.
Writer fields(std::size_t to_qos, std::size_t writer, std::size_t sequence) {
  return Writer().number(0, 2).number(to_qos, 2).number(0, 4).number(writer, 4).sequence(sequence);
}

constexpr std::size_t kPoseWriter = 0x03020000, kFrameWriter = 0x03010000;

void add_frame(std::size_t sequence, std::size_t frame_bytes, std::size_t datagram_bytes,
               std::vector<Datagram>& traffic) {
  const std::size_t fragments = (frame_bytes + datagram_bytes - 1) / datagram_bytes;
  for (std::size_t i = 0; i < fragments; ++i) {
    Writer body = fields(28, kFrameWriter, sequence);
    body.number(i + 1, 4).number(1, 2).number(datagram_bytes, 2).number(frame_bytes, 4);
    body.zeros(std::min(datagram_bytes, frame_bytes - i * datagram_bytes));
    traffic.push_back(datagram(kDataFragments, 0, body.take()));
  }
  traffic.push_back(datagram(kHeartbeat, 0,
                             Writer()
                                 .number(0, 4)
                                 .number(kFrameWriter, 4)
                                 .sequence(1)
                                 .sequence(sequence)
                                 .number(sequence, 4)
                                 .take()));
}

}  // namespace

std::vector<Datagram> second_of_traffic(std::size_t frame_bytes, std::size_t datagram_bytes) {
  std::vector<Datagram> traffic;
  for (std::size_t i = 0; i < kPoses; ++i) {
    traffic.push_back(datagram(kData, kHasPayload, fields(16, kPoseWriter, i + 1).zeros(kPoseBytes).take()));
    if (i % (kPoses / kFrames) == 0)
      add_frame(1 + i * kFrames / kPoses, frame_bytes, datagram_bytes, traffic);
  }
  return traffic;
}

}  // namespace laneloom::bench
