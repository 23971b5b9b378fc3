#include "bench/view_readers.hpp"

#include <gtest/gtest.h>

#include <string>

namespace laneloom::bench {
namespace {

std::vector<std::uint8_t> frame(std::uint8_t kind, std::size_t size) {
  std::vector<std::uint8_t> bytes{kind};
  if (size < 126) {
    bytes.push_back(static_cast<std::uint8_t>(size));
  } else {
    const int more = size < 65536 ? 2 : 8;
    bytes.push_back(more == 2 ? 126 : 127);
    for (int i = more - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(size >> (8 * i)));
  }
  bytes.insert(bytes.end(), size, 0x81);
  return bytes;
}

// A text, a ping, and a text of two frames, of all kinds of lengths, cut anywhere.
TEST(WebSocketCounter, CountsMessagesInPartsOfAnySize) {
  std::vector<std::uint8_t> bytes;
  for (const std::size_t size : {0U, 1U, 125U, 126U, 65535U, 65536U, 200'000U})
    for (const std::uint8_t kind : std::initializer_list<std::uint8_t>{0x81, 0x89, 0x01, 0x80}) {
      const auto next = frame(kind, size);
      bytes.insert(bytes.end(), next.begin(), next.end());
    }
  for (const std::size_t part : {std::size_t{1}, std::size_t{7}, std::size_t{4096}, bytes.size()}) {
    WebSocketCounter counter;
    for (std::size_t at = 0; at < bytes.size(); at += part)
      counter.add(bytes.data() + at, std::min(part, bytes.size() - at));
    EXPECT_EQ(counter.messages(), 7 * 2U) << part;
  }
}

}  // namespace
}  // namespace laneloom::bench
