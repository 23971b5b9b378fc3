#include "io/feather.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "io/feather_writer.hpp"
#include "temporary_folder.hpp"

namespace laneloom::io {
namespace {

using testing::HasSubstr;

class Feather : public testing::Test {
 protected:
  void write(const recording::Bytes& bytes) const { write_bytes(file_, bytes); }
  FeatherTable open() const { return FeatherTable(file_); }

  /// The complaint about the file of these bytes; empty: there is none.
  std::string refusal(const recording::Bytes& bytes) const {
    write(bytes);
    try {
      const FeatherTable table = open();
      EXPECT_EQ(table.column<std::int64_t>("stamp").size(), table.rows());
      EXPECT_EQ(table.column<std::string>("name").size(), table.rows());
      EXPECT_EQ(table.column<double>("x").size(), table.rows());
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr(file_));
      return error.what();
    }
    return "";
  }

  const std::vector<std::int64_t> stamps_{315966265660000000, 315966265660000001, -1};
  const std::vector<double> x_{0.1, -2e300, 3.0};
  const std::vector<std::string> names_{"car", "", "two words, and ü"};
  const FeatherWriter::Columns columns_{{"stamp", stamps_}, {"name", names_}, {"x", x_}};

 private:
  TemporaryFolder folder_;
  std::string file_ = folder_.file("table.feather");
};

TEST_F(Feather, CellsAreReadAsTheyWereWritten) {
  for (const auto compression :
       {recording::Compression::lz4, recording::Compression::zstd, recording::Compression::none}) {
    for (const std::size_t rows_per_batch : {1U, 2U, 3U}) {
      write(FeatherWriter(columns_, compression).write(rows_per_batch));
      const FeatherTable table = open();
      EXPECT_EQ(table.rows(), 3u);
      EXPECT_EQ(table.column<std::int64_t>("stamp"), stamps_) << "to the last bit";
      EXPECT_EQ(table.column<std::string>("name"), names_);
      EXPECT_EQ(table.column<double>("x"), x_);
    }
  }
}

TEST_F(Feather, WhatIsNoTableOfTheseColumnsIsNamed) {
  EXPECT_THAT(refusal({}), HasSubstr("is no Feather file"));
  EXPECT_THAT(refusal({'F', 'E', 'A', '1', 0, 0, 0, 0}), HasSubstr("is no Feather file"));
  EXPECT_THAT(refusal(FeatherWriter({{"stamp", stamps_}, {"name", names_}}).write()),
              HasSubstr("has no column x"));
  EXPECT_THAT(refusal(FeatherWriter({{"stamp", x_}, {"x", x_}}).write()),
              HasSubstr("the column stamp must be of 64-bit integers"));
  EXPECT_THAT(refusal(FeatherWriter({{"stamp", stamps_}, {"name", x_}}).write()),
              HasSubstr("the column name must be of texts"));
  EXPECT_THAT(refusal(FeatherWriter({{"stamp", stamps_}, {"name", names_}, {"x", stamps_}}).write()),
              HasSubstr("the column x must be of 64-bit floating-point numbers"));
}

TEST_F(Feather, AFileThatIsCutOffAnywhereIsRefused) {
  const recording::Bytes whole = FeatherWriter(columns_).write(2);
  ASSERT_EQ(refusal(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_NE(refusal({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
}

TEST_F(Feather, DamageAnywhereIsSurvived) {
  std::mt19937 random(1);
  for (const auto compression :
       {recording::Compression::lz4, recording::Compression::zstd, recording::Compression::none}) {
    const recording::Bytes whole = FeatherWriter(columns_, compression).write(2);
    int refused = 0;
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
      recording::Bytes damaged = whole;
      damaged[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
      if (!refusal(damaged).empty()) ++refused;
    }
    EXPECT_GT(refused, 500);
    for (int i = 0; i < 2000; ++i) {  // several at once, lengths of all ones among them
      recording::Bytes damaged = whole;
      for (int byte = 0; byte < 4; ++byte)
        damaged[random() % damaged.size()] = random() % 2 == 0 ? 0xFF : static_cast<std::uint8_t>(random());
      refusal(damaged);
    }
  }
}

TEST_F(Feather, WhatWouldTakeAllMemoryIsRefused) {
  const std::vector<std::int64_t> many(1'000'001, 0);
  EXPECT_THAT(refusal(FeatherWriter({{"stamp", many}}).write(2'000'000)),
              HasSubstr("more than a million rows"));
  const std::vector<std::string> long_text{std::string((1U << 26U) + 1, 'x')};
  EXPECT_THAT(refusal(FeatherWriter({{"stamp", std::vector<std::int64_t>{1}}, {"name", long_text}}).write()),
              HasSubstr("a column of texts is too long"));
}

}  // namespace
}  // namespace laneloom::io
