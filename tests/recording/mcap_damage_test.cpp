#include <algorithm>
#include <random>

#include "allocations.hpp"
#include "file_size_limit.hpp"
#include "mcap_fixture.hpp"

namespace laneloom::recording {
namespace {

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

TEST_F(McapTest, ADamagedLengthLosesOneChunkAlone) {
  const auto messages = by_time(random_messages(70, 5));
  // The third chunk's record is longer than the file, or swallows the fourth, or is shorter than it was.
  for (const auto& [byte, value] : {std::pair(8, 0x7f), std::pair(2, 0x10), std::pair(2, 0x01)}) {
    const auto ends = write_in_chunks(messages, Compression::none);
    Bytes bytes = bytes_of(path_);
    bytes[ends[2].size + static_cast<std::size_t>(byte)] = static_cast<std::uint8_t>(value);
    write_bytes(path_, bytes);
    McapReader reader(path_);
    LeftOut left_out;
    std::size_t count = 0;
    while (next_or_leave_out(left_out, [&] { return reader.next(); })) ++count;
    EXPECT_EQ(count, messages.size() - 7);
    EXPECT_GE(left_out.count(), 2U);  // the chunk, and the messages that are missing
    EXPECT_NE(left_out.summary().find("(first: byte " + std::to_string(ends[2].size) + ")"),
              std::string::npos)
        << left_out.summary();
    LeftOut strict(/*strict=*/true);
    McapReader again(path_);
    EXPECT_THROW(next_or_leave_out(strict, [&] { return again.next(); }), Damage);
  }
}

/// A file whose messages lie outside of chunks, as other writers make them.
class McapWithoutChunks : public McapTest {
 protected:
  static constexpr std::size_t kLengthAt = 1;  ///< of a record, behind its opcode
  const std::vector<Message> messages_ = by_time(random_messages(70, 5));

  /// Returns the places of the messages.
  std::vector<std::size_t> write_without_chunks() {
    Bytes bytes(kMcapMagic.begin(), kMcapMagic.end());
    const auto add = [&](McapOpcode opcode, const Bytes& content) {
      const Bytes added = record(static_cast<std::uint8_t>(opcode), content);
      bytes.insert(bytes.end(), added.begin(), added.end());
    };
    add(McapOpcode::header, Bytes(8));  // two empty texts
    add(McapOpcode::schema, content([](ByteWriter& to) {
          to.number(std::uint16_t{1});
          for (const char* text : {"type a", "omgidl", "text a"}) to.text(text);
        }));
    add(McapOpcode::channel, content([](ByteWriter& to) {
          to.number(std::uint16_t{1});  // the channel
          to.number(std::uint16_t{1});  // its schema
          for (const char* text : {"a", "cdr"}) to.text(text);
          to.number(std::uint32_t{0});
        }));
    std::vector<std::size_t> places;
    for (const Message& message : messages_) {
      places.push_back(bytes.size());
      add(McapOpcode::message, content([&](ByteWriter& to) {
            to.number(std::uint16_t{1});
            to.number(message.sequence);
            to.number(message.log_time_ns);
            to.number(message.publish_time_ns);
            to.bytes(message.data);
          }));
    }
    add(McapOpcode::data_end, Bytes(4));
    add(McapOpcode::statistics,
        content([&](ByteWriter& to) { to.number(static_cast<std::uint64_t>(messages_.size())); }));
    add(McapOpcode::footer, Bytes(kMcapFooterBytes));
    bytes.insert(bytes.end(), kMcapMagic.begin(), kMcapMagic.end());
    write_bytes(path_, bytes);
    return places;
  }
  template <typename Write>
  static Bytes content(Write write) {
    Bytes bytes;
    ByteWriter writer(bytes);
    write(writer);
    return bytes;
  }
  /// The sequences of the messages that come, past all damage.
  std::vector<std::uint32_t> sequences(LeftOut& left_out) {
    McapReader reader(path_);
    std::vector<std::uint32_t> found;
    while (const auto message = next_or_leave_out(left_out, [&] { return reader.next(); }))
      found.push_back(message->sequence);
    return found;
  }
  /// The sequences of all messages but one.
  std::vector<std::uint32_t> sequences_without(std::size_t lost) {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < messages_.size(); ++i)
      if (i != lost) all.push_back(messages_[i].sequence);
    return all;
  }
};

TEST_F(McapWithoutChunks, ADamagedLengthLosesOneMessageAlone) {
  // The message is longer than the file, or swallows a few others, or many.
  for (const auto& [byte, value] : {std::pair(7, 0x7f), std::pair(1, 0x03), std::pair(1, 0x20)})
    for (const std::size_t lost : {std::size_t{1}, std::size_t{30}, messages_.size() - 1}) {
      SCOPED_TRACE(testing::Message() << byte << " of message " << lost);
      const auto places = write_without_chunks();
      Bytes bytes = bytes_of(path_);
      bytes[places[lost] + kLengthAt + static_cast<std::size_t>(byte)] = static_cast<std::uint8_t>(value);
      write_bytes(path_, bytes);
      LeftOut left_out;
      EXPECT_EQ(sequences(left_out), sequences_without(lost));
      EXPECT_NE(left_out.summary().find("(first: byte " + std::to_string(places[lost]) + ")"),
                std::string::npos)
          << left_out.summary();
      LeftOut strict(/*strict=*/true);
      EXPECT_THROW(sequences(strict), Damage);
    }
}

TEST_F(McapWithoutChunks, AMessageThatSaysToBeShorterLosesNoOther) {
  const auto places = write_without_chunks();
  Bytes bytes = bytes_of(path_);
  bytes[places[30] + kLengthAt] = kMcapMessageHeaderBytes;
  bytes[places[30] + kLengthAt + 1] = 0;
  write_bytes(path_, bytes);
  LeftOut left_out;
  std::vector<std::uint32_t> found = sequences(left_out);
  std::erase(found, messages_[30].sequence);
  EXPECT_EQ(found, sequences_without(30));
  EXPECT_GE(left_out.count(), 1U);
}

TEST_F(McapWithoutChunks, ADamagedMessageIsSkippedInAFileThatIsCutOff) {
  const auto places = write_without_chunks();
  Bytes bytes = bytes_of(path_);
  bytes[places[30] + kLengthAt + 7] = 0x7f;
  bytes.resize(places[50] + 20);
  write_bytes(path_, bytes);
  LeftOut left_out;
  std::vector<std::uint32_t> whole = sequences_without(30);
  whole.resize(49);
  EXPECT_EQ(sequences(left_out), whole);
  EXPECT_EQ(left_out.count(), 1U);
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
}  // namespace laneloom::recording
