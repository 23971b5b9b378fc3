#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "allocations.hpp"
#include "file_size_limit.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "temporary_folder.hpp"

namespace laneloom {
namespace {

struct Message {
  std::string topic;
  std::uint64_t log_time_ns = 0, publish_time_ns = 0;
  std::uint32_t sequence = 0;
  Bytes data;
  bool operator==(const Message&) const = default;
};

constexpr Compression kCompressions[] = {Compression::none, Compression::lz4, Compression::zstd};

std::vector<Message> random_messages(std::size_t count, unsigned seed,
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

std::vector<Message> by_time(std::vector<Message> messages) {
  std::ranges::stable_sort(messages, {}, &Message::log_time_ns);
  return messages;
}

McapChannel channel_of(const std::string& topic) {
  return {topic, "cdr", std::make_shared<McapSchema>(McapSchema{"type " + topic, "omgidl", "text " + topic})};
}

class McapTest : public ::testing::Test {
 protected:
  void write(const std::vector<Message>& messages, Compression compression = Compression::zstd,
             std::size_t chunk_bytes = 2000) {
    std::filesystem::remove(path_);
    McapWriter writer(path_, compression, chunk_bytes);
    const auto a = writer.add_channel(channel_of("a"));
    const auto b = writer.add_channel(channel_of("b"));
    for (const auto& m : messages)
      writer.write(m.topic == "a" ? a : b, m.log_time_ns, m.publish_time_ns, m.sequence, m.data);
    writer.close();
  }

  /// Everything up to the end, or to what `error` says.
  std::vector<Message> read(std::string* error = nullptr, const RecordingLimits& limits = {}) {
    std::vector<Message> messages;
    try {
      McapReader reader(path_, limits);
      cut_off_ = reader.cut_off();
      while (const auto m = reader.next()) {
        EXPECT_TRUE(m->channel->schema);
        messages.push_back({m->channel->topic, m->log_time_ns, m->publish_time_ns, m->sequence,
                            Bytes(m->data.begin(), m->data.end())});
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
    McapReader reader(path_);
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

  /// What went to disk with each chunk: the file's size after it, and how many messages it has until then.
  struct ChunkEnd {
    std::uint64_t size;
    std::size_t messages;
  };
  std::vector<ChunkEnd> write_in_chunks(const std::vector<Message>& messages, Compression compression) {
    std::filesystem::remove(path_);
    McapWriter writer(path_, compression, 1U << 20U);
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
  static Bytes record(std::uint8_t opcode, const Bytes& content) {
    Bytes bytes;
    ByteWriter writer(bytes);
    writer.number(opcode);
    writer.number(std::uint64_t{content.size()});
    writer.bytes(content);
    return bytes;
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("test.mcap");
  bool cut_off_ = false;
};

TEST_F(McapTest, WhatIsWrittenIsReadInTheOrderOfLogTimes) {
  for (const auto compression : kCompressions) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      const auto messages = random_messages(500, seed);
      write(messages, compression);
      EXPECT_EQ(read(), by_time(messages));
      EXPECT_FALSE(cut_off_);
    }
  }
}

TEST_F(McapTest, MessagesOfOneTimeKeepTheirOrder) {
  const auto messages = random_messages(500, 1, 5);
  write(messages);
  EXPECT_EQ(read(), by_time(messages));
}

TEST_F(McapTest, CompressionMakesFilesSmaller) {
  const auto messages = random_messages(500, 1);
  std::vector<std::uintmax_t> sizes;
  for (const auto compression : kCompressions) {
    write(messages, compression, 100'000);
    sizes.push_back(std::filesystem::file_size(path_));
  }
  EXPECT_LT(sizes[1], sizes[0] * 3 / 4);
  EXPECT_LT(sizes[2], sizes[1]);
}

TEST_F(McapTest, AnEmptyFileHasNoMessages) {
  write({});
  EXPECT_TRUE(read().empty());
  EXPECT_FALSE(cut_off_);
}

TEST_F(McapTest, WholeChunksOutliveAnyCut) {
  auto messages = by_time(random_messages(300, 3));
  for (const auto compression : kCompressions) {
    const auto ends = write_in_chunks(messages, compression);
    const Bytes whole = bytes_of(path_);
    std::mt19937 engine(4);
    for (int round = 0; round < 700; ++round) {
      // Many cuts near the ends of chunks, where it is decided whether they count.
      const std::uint64_t near = ends[engine() % ends.size()].size + engine() % 61;
      const std::uint64_t cut =
          round % 2 == 0 ? 8 + engine() % (whole.size() - 8) : std::min(near - 30, whole.size() - 1);
      write_bytes(path_, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut)));
      const auto read_back = read();
      EXPECT_TRUE(cut_off_);
      std::size_t safe = 0;
      for (const auto& end : ends) safe = end.size <= cut ? end.messages : safe;
      // A chunk is whole before its message indexes are.
      EXPECT_GE(read_back.size(), safe) << cut;
      EXPECT_LE(read_back.size(), safe + 7) << cut;
      EXPECT_TRUE(std::equal(read_back.begin(), read_back.end(), messages.begin())) << cut;
    }
  }
}

TEST_F(McapTest, ZerosInPlaceOfTheEndAreACut) {
  const auto messages = by_time(random_messages(70, 3));
  const auto ends = write_in_chunks(messages, Compression::lz4);
  Bytes bytes = bytes_of(path_);
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(ends[5].size), bytes.end(), std::uint8_t{0});
  write_bytes(path_, bytes);
  EXPECT_EQ(read().size(), ends[5].messages);
  EXPECT_TRUE(cut_off_);
}

TEST_F(McapTest, DamageIsNoticedOrHarmlessAndTakesNoMemory) {
  const auto messages = random_messages(200, 5);
  const RecordingLimits limits{.max_chunk_bytes = 1U << 20U, .max_open_bytes = 4U << 20U};
  std::mt19937 engine(6);
  int noticed = 0;
  constexpr int kRounds = 1500;
  for (const auto compression : kCompressions) {
    write(messages, compression);
    const Bytes whole = bytes_of(path_);
    for (int round = 0; round < kRounds; ++round) {
      Bytes damaged = whole;
      for (unsigned i = 0; i <= engine() % 3; ++i)
        damaged[engine() % damaged.size()] ^= static_cast<std::uint8_t>(1U << engine() % 8);
      if (round % 3 == 0) {  // lengths are eight bytes with mostly zeros
        const std::size_t at = engine() % (damaged.size() - 8);
        std::memset(&damaged[at], static_cast<int>(engine() % 256), 8);
      }
      write_bytes(path_, damaged);
      std::string error;
      watch_allocations();
      const auto read_back = read(&error, limits);
      EXPECT_LT(peak_bytes(), 8U << 20U);
      const bool seen = !error.empty() || cut_off_;
      EXPECT_TRUE(seen || read_back == by_time(messages));
      noticed += seen ? 1 : 0;
    }
  }
  // The rest hit indexes, which are not used, or the name of the writer.
  // none.
  EXPECT_GT(noticed, kRounds);
}

TEST_F(McapTest, ADamagedMessageIsNoticedByItsChunksCrc) {
  const auto messages = by_time(random_messages(70, 5));
  const auto ends = write_in_chunks(messages, Compression::none);
  Bytes bytes = bytes_of(path_);
  // In the third chunk, which the CRC of its content guards.
  bytes[ends[2].size + 200] ^= 1U;
  write_bytes(path_, bytes);
  std::string error;
  EXPECT_EQ(read(&error).size(), ends[2].messages);
  EXPECT_NE(error.find("at byte " + std::to_string(ends[2].size + kMcapRecordHeaderBytes)), std::string::npos)
      << error;
  EXPECT_NE(error.find("CRC"), std::string::npos) << error;

  const auto [count, failures] = read_past_damage();
  EXPECT_EQ(failures, 2U);                // the chunk, and at the end that messages are missing
  EXPECT_EQ(count, messages.size() - 7);  // what is behind the damage comes
}

// Then all chunks are read at once, for the channels that they describe.
TEST_F(McapTest, ADamagedChunkLeavesTheOthersReadableWithoutASummaryAndOrder) {
  const auto messages = random_messages(70, 5);
  const auto ends = write_in_chunks(messages, Compression::none);
  Bytes bytes = bytes_of(path_);
  bytes[ends[2].size + 200] ^= 1U;
  bytes.resize(ends.back().size);
  write_bytes(path_, bytes);
  const auto [count, failures] = read_past_damage();
  EXPECT_EQ(failures, 1U);
  EXPECT_EQ(count, messages.size() - 7);
}

TEST_F(McapTest, ForeignFilesAreRefused) {
  for (const auto& content : {Bytes{}, Bytes{'{', '}'}, Bytes(1000, 0), Bytes(1000, 'x')}) {
    write_bytes(path_, content);
    std::string error;
    read(&error);
    EXPECT_NE(error.find("no MCAP file"), std::string::npos) << error;
  }
  std::filesystem::remove(path_);
  std::string error;
  read(&error);
  EXPECT_NE(error.find("No such file"), std::string::npos) << error;
  EXPECT_THROW(McapReader(folder_.path()), std::runtime_error);
  EXPECT_THROW(McapReader("/dev/zero"), std::runtime_error);
}

TEST_F(McapTest, LimitsAreKept) {
  write(random_messages(100, 1), Compression::zstd, 1U << 20U);
  std::string error;
  EXPECT_TRUE(read(&error, {.max_chunk_bytes = 1000}).empty());
  EXPECT_NE(error.find("1000 are allowed"), std::string::npos) << error;

  // A chunk that claims to have been huge.
  const auto messages = random_messages(100, 1);
  write(messages, Compression::zstd, 1U << 20U);
  Bytes bytes = bytes_of(path_);
  const char name[] = "zstd";
  const auto found = std::search(bytes.begin(), bytes.end(), name, name + 4);
  ASSERT_NE(found, bytes.end());
  *(found - 4 - 4 - 2) = 0x7f;  // in the uncompressed size, before CRC and the text's length
  write_bytes(path_, bytes);
  watch_allocations();
  read(&error);
  EXPECT_LT(peak_bytes(), 1U << 20U);
  EXPECT_NE(error.find("are allowed"), std::string::npos) << error;
}

TEST_F(McapTest, TooManyChunksOfOneTimeAreRefused) {
  auto messages = random_messages(2000, 1, 1000);
  write(messages, Compression::none, 2000);  // each chunk covers all times
  EXPECT_EQ(read().size(), messages.size());
  std::string error;
  read(&error, {.max_chunk_bytes = 10'000, .max_open_bytes = 50'000});
  EXPECT_NE(error.find("overlap"), std::string::npos) << error;
  // Chunks one after the other fit.
  write(by_time(messages), Compression::none, 2000);
  EXPECT_EQ(read(nullptr, {.max_chunk_bytes = 10'000, .max_open_bytes = 50'000}).size(), messages.size());
}

TEST_F(McapTest, UnknownRecordsArePassedOver) {
  const auto messages = by_time(random_messages(50, 1));
  const auto ends = write_in_chunks(messages, Compression::zstd);
  Bytes bytes = bytes_of(path_);
  Bytes more = record(0x80, Bytes(5000, 1));
  for (const std::uint8_t opcode : Bytes{0x09, 0x0c, 0x7f, 0xff}) {
    const Bytes other = record(opcode, Bytes(opcode, 0));
    more.insert(more.end(), other.begin(), other.end());
  }
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(ends[3].size), more.begin(), more.end());
  write_bytes(path_, bytes);
  EXPECT_EQ(read(), messages);
}

TEST_F(McapTest, WhatContradictsItselfIsRefused) {
  const auto messages = random_messages(20, 1);
  const auto ends = write_in_chunks(messages, Compression::zstd);
  const Bytes whole = bytes_of(path_);
  const auto with = [&](const Bytes& inserted) {
    Bytes bytes = whole;
    bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(ends[0].size), inserted.begin(), inserted.end());
    write_bytes(path_, bytes);
    std::string error;
    read(&error);
    return error;
  };
  Bytes message(kMcapMessageHeaderBytes, 0);
  message[0] = 9;
  EXPECT_NE(with(record(0x05, message)).find("channel 9 is not described"), std::string::npos);
  EXPECT_NE(with(record(0x05, Bytes(21, 0))).find("too short"), std::string::npos);
  EXPECT_NE(with(record(0x06, Bytes(7, 0))).find("too short"), std::string::npos);
  EXPECT_NE(with(record(0x01, {})).find("header"), std::string::npos);
  EXPECT_NE(with(record(0x00, {})).find("or none"), std::string::npos);
  Bytes schema;
  ByteWriter writer(schema);
  writer.number(std::uint16_t{1});
  writer.text("other");
  writer.text("omgidl");
  writer.text("");
  EXPECT_NE(with(record(0x03, schema)).find("schema 1 is described in two ways"), std::string::npos);
  Bytes channel;
  ByteWriter channel_writer(channel);
  channel_writer.number(std::uint16_t{7});
  channel_writer.number(std::uint16_t{8});
  channel_writer.text("c");
  channel_writer.text("cdr");
  EXPECT_NE(with(record(0x04, channel)).find("has a schema that is not there"), std::string::npos);
}

TEST_F(McapTest, AnExistingFileIsNotOverwritten) {
  write_bytes(path_, {'m', 'i', 'n', 'e'});
  EXPECT_THROW(McapWriter(path_, Compression::none, 1000), std::runtime_error);
  EXPECT_EQ(bytes_of(path_).size(), 4U);
}

TEST_F(McapTest, AFullDiskKeepsWhatIsWritten) {
  const auto messages = by_time(random_messages(300, 5));
  std::size_t written = 0;
  {
    const FileSizeLimit limit(20'000);
    McapWriter writer(path_, Compression::none, 2000);
    const auto a = writer.add_channel(channel_of("a"));
    writer.add_channel(channel_of("b"));
    std::string error;
    for (const auto& m : messages) {
      try {
        writer.write(a, m.log_time_ns, m.publish_time_ns, m.sequence, m.data);
        ++written;
      } catch (const std::runtime_error& caught) {
        error = caught.what();
        break;
      }
    }
    EXPECT_EQ(error, path_ + ": File too large");
    EXPECT_THROW(writer.close(), std::runtime_error);
  }
  const auto read_back = read();
  EXPECT_TRUE(cut_off_);
  EXPECT_LT(written, messages.size());
  EXPECT_GT(read_back.size() + 40, written);  // all but what waited for its chunk
  for (std::size_t i = 0; i < read_back.size(); ++i) EXPECT_EQ(read_back[i].data, messages[i].data);
}

TEST_F(McapTest, ARecordingCanBeFinishedWhenThereIsRoomAgain) {
  const auto messages = by_time(random_messages(100, 5));
  McapWriter writer(path_, Compression::none, 2000);
  const auto a = writer.add_channel(channel_of("a"));
  {
    const FileSizeLimit limit(10'000);
    int failures = 0;
    for (const auto& m : messages) {
      try {
        writer.write(a, m.log_time_ns, m.publish_time_ns, m.sequence, m.data);
      } catch (const std::runtime_error&) {
        ++failures;
      }
    }
    EXPECT_GT(failures, 0);
  }
  writer.close();
  EXPECT_EQ(read().size(), messages.size());
  EXPECT_FALSE(cut_off_);
}

}  // namespace
}  // namespace laneloom
