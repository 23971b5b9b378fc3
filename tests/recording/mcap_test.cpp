#include <algorithm>
#include <random>

#include "allocations.hpp"
#include "mcap_fixture.hpp"

namespace laneloom::recording {
namespace {

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
  EXPECT_NE(with(record(0x06, Bytes(7, 0))).find("another length"), std::string::npos);
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

}  // namespace
}  // namespace laneloom::recording
