#include "snapshot/snapshot_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "mapping/state_bytes.hpp"
#include "snapshot/snapshot_writer.hpp"
#include "temporary_folder.hpp"
#include "thrown_by.hpp"

namespace laneloom::snapshot {
namespace {

using ::testing::HasSubstr;
constexpr std::int64_t kSecond = 1'000'000'000;

class SnapshotFileTest : public ::testing::Test {
 protected:
  static Snapshot snapshot() {
    Snapshot result{
        {"1.0 abc", 100 * kSecond, 500 * kSecond}, 77, {1, 2, 3, 4, {5, 6, 7}}, MapperState(MapperConfig{})};
    result.state.ids = markings::IdSource(42);
    result.state.map.boundaries.push_back(Marking{.id = 7, .points = {{1, 2, 3}, {4, 5, 6}}});
    result.state.map.lanes.push_back(Lane{.id = 8, .left_borders = {{.reversed = true}}});
    result.state.map.lanes.push_back(Lane{.id = 9, .right_borders = {{.reversed = true}}});
    return result;
  }
  Snapshot read(const SnapshotStamp& now) const { return read_snapshot(file_, now, 5.0, MapperConfig{}); }
  /// Why it is not read; empty: it is.
  std::string refusal(const SnapshotStamp& now) const {
    return thrown_by([&] { read(now); });
  }
  std::string bytes() const {
    std::ostringstream bytes;
    bytes << std::ifstream(file_, std::ios::binary).rdbuf();
    return std::move(bytes).str();
  }

  const SnapshotStamp soon_{"1.0 abc", 103 * kSecond, 503 * kSecond};
  const TemporaryFolder folder_;
  const std::string file_ = folder_.file("map");
};

TEST_F(SnapshotFileTest, IsTakenThreeTimesAtMost) {
  EXPECT_EQ(take_snapshot(file_), "");
  write_snapshot(file_, snapshot());
  for (int times = 0; times < 3; ++times) {
    const std::string taken = take_snapshot(file_);
    EXPECT_FALSE(std::filesystem::exists(file_));
    EXPECT_EQ(read_snapshot(taken, soon_, 5.0, MapperConfig{}).map_id, 77U);
  }
  EXPECT_EQ(take_snapshot(file_), "");
}

TEST_F(SnapshotFileTest, ANewOneIsTakenBeforeThoseThatWereTaken) {
  write_snapshot(file_, snapshot());
  take_snapshot(file_);
  Snapshot newer = snapshot();
  newer.map_id = 78;
  write_snapshot(file_, newer);
  for (int times = 0; times < 3; ++times)
    EXPECT_EQ(read_snapshot(take_snapshot(file_), soon_, 5.0, MapperConfig{}).map_id, 78U);
  EXPECT_EQ(take_snapshot(file_), "");
}

// A wrong path, as that of a folder or of the configuration.
/// The power failed while the file was written.
TEST_F(SnapshotFileTest, WhatLostItsBytesKeepsNobodyFromStarting) {
  for (const std::string& left : {std::string(), std::string("abc"), std::string(4096, '\0')}) {
    std::ofstream(file_, std::ios::trunc) << left;
    EXPECT_EQ(thrown_by([&] { check_snapshot_file(file_); }), "");
    EXPECT_EQ(take_snapshot(file_), file_ + ".1");
    std::filesystem::remove(file_ + ".1");
  }
}

TEST_F(SnapshotFileTest, WhatIsNoSnapshotStaysWhereItIs) {
  EXPECT_EQ(thrown_by([&] { check_snapshot_file(file_); }), "");
  std::filesystem::create_directory(file_ + ".new");
  EXPECT_THAT(thrown_by([&] { take_snapshot(file_); }), HasSubstr(file_ + ".new is no regular file"));
  std::filesystem::remove(file_ + ".new");
  write_snapshot(file_, snapshot());
  std::ofstream(file_ + ".2") << "service:\n  log_level: info\n";
  EXPECT_THAT(thrown_by([&] { take_snapshot(file_); }), HasSubstr(file_ + ".2 is no snapshot"));
  EXPECT_THAT(thrown_by([&] { check_snapshot_file(file_); }), HasSubstr(file_ + ".2 is no snapshot"));
  EXPECT_TRUE(std::filesystem::exists(file_)) << "nothing was moved";
  EXPECT_GT(std::filesystem::file_size(file_ + ".2"), 0U);
}

TEST_F(SnapshotFileTest, ABrokenOneIsTaken) {
  write_snapshot(file_, snapshot());
  std::filesystem::resize_file(file_, 100);
  EXPECT_EQ(take_snapshot(file_), file_ + ".1");
  std::ofstream(file_).flush();
  EXPECT_EQ(take_snapshot(file_), file_ + ".1") << "a file that lost its bytes";
}

TEST_F(SnapshotFileTest, AFolderThatCannotTakeItIsTold) {
  EXPECT_THAT(thrown_by([&] { check_snapshot_file(folder_.file("none/map")); }),
              HasSubstr("No such file or directory"));
}

TEST_F(SnapshotFileTest, ComesBackAsItWas) {
  write_snapshot(file_, snapshot());
  const auto back = read(soon_);
  EXPECT_EQ(to_bytes(back.state), to_bytes(snapshot().state));
  ASSERT_EQ(back.state.map.lanes.size(), 2U);
  EXPECT_TRUE(back.state.map.lanes[0].left_borders.at(0).reversed);
  EXPECT_TRUE(back.state.map.lanes[1].right_borders.at(0).reversed);
  EXPECT_EQ(back.checkpoint.frame_stamp_ns, 1);
  EXPECT_EQ(back.checkpoint.frame_arrival_ns, 2);
  EXPECT_EQ(back.checkpoint.pose_stamp_ns, 3);
  EXPECT_EQ(back.checkpoint.pose_session_id, 4U);
  EXPECT_EQ(back.checkpoint.position, Point(5, 6, 7));
}

TEST_F(SnapshotFileTest, IsRefusedWhenItIsOldOrFromBeforeTheHostStarted) {
  write_snapshot(file_, snapshot());
  EXPECT_EQ(refusal({"1.0 abc", 105 * kSecond, 505 * kSecond}), "");
  EXPECT_THAT(refusal({"1.0 abc", 106 * kSecond, 503 * kSecond}), HasSubstr("6.0"));
  EXPECT_THAT(refusal({"1.0 abc", 103 * kSecond, 900 * kSecond}), HasSubstr("400.0"));
  EXPECT_THAT(refusal({"1.0 abc", 3 * kSecond, 503 * kSecond}), HasSubstr("-97.0"));
}

TEST_F(SnapshotFileTest, IsRefusedWhenAnotherVersionOrConfigurationMadeIt) {
  write_snapshot(file_, snapshot());
  EXPECT_THAT(refusal({"1.1 abc", 103 * kSecond, 503 * kSecond}), HasSubstr("made by 1.0 abc"));
  EXPECT_THAT(refusal({"1.0 abd", 103 * kSecond, 503 * kSecond}), HasSubstr("made by 1.0 abc"));
}

TEST_F(SnapshotFileTest, IsRefusedWhereverItIsDamaged) {
  write_snapshot(file_, snapshot());
  const std::string whole = bytes();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    std::ofstream(file_, std::ios::binary) << damaged;
    EXPECT_EQ(refusal(soon_), "damaged") << "byte " << i;
  }
  for (const std::size_t length :
       {whole.size() - 1, whole.size() / 2, std::size_t{8}, std::size_t{3}, std::size_t{0}}) {
    std::ofstream(file_, std::ios::binary) << whole.substr(0, length);
    EXPECT_EQ(refusal(soon_), "damaged") << length << " bytes";
  }
}

TEST_F(SnapshotFileTest, IsRefusedWhereItMayBeAnothers) {
  write_snapshot(folder_.file("elsewhere"), snapshot());
  std::filesystem::create_symlink(folder_.file("elsewhere"), file_);
  EXPECT_EQ(refusal(soon_), "is a link");
}

TEST_F(SnapshotFileTest, IsReadByItsUserAlone) {
  const auto before = umask(0);
  write_snapshot(file_, snapshot());
  umask(before);
  EXPECT_EQ(std::filesystem::status(file_).permissions(), std::filesystem::perms{0600});
}

TEST_F(SnapshotFileTest, TheWriterCountsWhatItDid) {
  const auto wait_for = [](const SnapshotWriter& writer, std::uint64_t SnapshotWriter::Totals::*count) {
    for (int i = 0; i < 2000 && writer.totals().*count == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  };
  SnapshotWriter writer(file_);
  writer.write(snapshot());
  wait_for(writer, &SnapshotWriter::Totals::written);
  EXPECT_EQ(writer.totals().written, 1U);
  EXPECT_EQ(refusal(soon_), "");

  SnapshotWriter nowhere(folder_.file("none/map"));
  nowhere.write(snapshot());
  wait_for(nowhere, &SnapshotWriter::Totals::failed);
  EXPECT_EQ(nowhere.totals().failed, 1U);
  EXPECT_EQ(nowhere.totals().written, 0U);
}

}  // namespace
}  // namespace laneloom::snapshot
