#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "temporary_folder.hpp"

namespace laneloom {

struct Message {
  std::string topic;
  std::uint64_t log_time_ns = 0, publish_time_ns = 0;
  std::uint32_t sequence = 0;
  recording::Bytes data;
  bool operator==(const Message&) const = default;
};

inline constexpr recording::Compression kCompressions[] = {
    recording::Compression::none, recording::Compression::lz4, recording::Compression::zstd};

inline std::vector<Message> random_messages(std::size_t count, unsigned seed,
                                            std::uint64_t max_time_ns = 1'000'000) {
  std::mt19937 engine(seed);
  std::vector<Message> messages(count);
  for (auto& message : messages) {
    message.topic = engine() % 2 == 0 ? "a" : "b";
    message.log_time_ns = engine() % max_time_ns;
    message.publish_time_ns = engine();
    message.sequence = static_cast<std::uint32_t>(engine());
    message.data.resize(engine() % 300);
    std::ranges::generate(message.data, [&] { return static_cast<std::uint8_t>(engine() % 4); });
  }
  return messages;
}

inline std::vector<Message> by_time(std::vector<Message> messages) {
  std::ranges::stable_sort(messages, {}, &Message::log_time_ns);
  return messages;
}

inline recording::McapChannel channel_of(const std::string& topic) {
  return {topic, "cdr",
          std::make_shared<recording::McapSchema>(
              recording::McapSchema{"type " + topic, "omgidl", "text " + topic})};
}

class McapTest : public ::testing::Test {
 protected:
  void write(const std::vector<Message>& messages,
             recording::Compression compression = recording::Compression::zstd,
             std::size_t chunk_bytes = 2000) {
    std::filesystem::remove(path_);
    recording::McapWriter writer(path_, compression, chunk_bytes);
    const auto a = writer.add_channel(channel_of("a"));
    const auto b = writer.add_channel(channel_of("b"));
    for (const auto& m : messages)
      writer.write(m.topic == "a" ? a : b, m.log_time_ns, m.publish_time_ns, m.sequence, m.data);
    writer.close();
  }

  /// Everything up to the end, or to what `error` says.
  std::vector<Message> read(std::string* error = nullptr, const recording::RecordingLimits& limits = {}) {
    std::vector<Message> messages;
    try {
      recording::McapReader reader(path_, limits);
      cut_off_ = reader.cut_off();
      while (const auto m = reader.next()) {
        EXPECT_TRUE(m->channel->schema);
        messages.push_back({m->channel->topic, m->log_time_ns, m->publish_time_ns, m->sequence,
                            recording::Bytes(m->data.begin(), m->data.end())});
      }
    } catch (const std::runtime_error& caught) {
      EXPECT_TRUE(std::string(caught.what()).starts_with(path_ + ": ")) << caught.what();
      if (error) *error = caught.what();
      if (!error) ADD_FAILURE() << caught.what();
    }
    return messages;
  }

  /// How many messages come, and how often damage is told.
  std::pair<std::size_t, std::size_t> read_past_damage() {
    recording::McapReader reader(path_);
    std::size_t count = 0, failures = 0;
    for (;;) {
      try {
        if (!reader.next()) return {count, failures};
        ++count;
      } catch (const std::runtime_error&) {
        ++failures;
      }
    }
  }

  /// The end of a chunk on disk: the file's size after it, and the number of messages until then.
  struct ChunkEnd {
    std::uint64_t size;
    std::size_t messages;
  };
  std::vector<ChunkEnd> write_in_chunks(const std::vector<Message>& messages,
                                        recording::Compression compression) {
    std::filesystem::remove(path_);
    recording::McapWriter writer(path_, compression, 1U << 20U);
    const auto a = writer.add_channel(channel_of("a"));
    const auto b = writer.add_channel(channel_of("b"));
    std::vector<ChunkEnd> ends{{writer.size(), 0}};
    for (std::size_t i = 0; i < messages.size(); ++i) {
      const auto& m = messages[i];
      writer.write(m.topic == "a" ? a : b, m.log_time_ns, m.publish_time_ns, m.sequence, m.data);
      if (i % 7 != 6) continue;
      writer.flush();
      ends.push_back({writer.size(), i + 1});
    }
    writer.close();
    return ends;
  }

  /// A record, to be put into a file.
  static recording::Bytes record(std::uint8_t opcode, const recording::Bytes& content) {
    recording::Bytes bytes;
    recording::ByteWriter writer(bytes);
    writer.number(opcode);
    writer.number(std::uint64_t{content.size()});
    writer.bytes(content);
    return bytes;
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("test.mcap");
  bool cut_off_ = false;
};

}  // namespace laneloom
