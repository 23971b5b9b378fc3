#include "snapshot/private_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "recording/file_size_limit.hpp"
#include "temporary_folder.hpp"

namespace laneloom::snapshot {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr uid_t kOther = 65534;

/// This process is another user's while this lasts.
class AsOther {
 public:
  AsOther() { EXPECT_EQ(seteuid(kOther), 0); }
  ~AsOther() { EXPECT_EQ(seteuid(0), 0); }
  AsOther(const AsOther&) = delete;
  AsOther& operator=(const AsOther&) = delete;
};

class PrivateFile : public ::testing::Test {
 protected:
  PrivateFile() : before_(umask(0)) { fs::permissions(folder_.path(), fs::perms{0755}); }
  ~PrivateFile() override { umask(before_); }

  mode_t mode() const {
    struct stat status {};
    EXPECT_EQ(lstat(file_.c_str(), &status), 0);
    return status.st_mode;
  }
  void expect_refusal(const std::string& why) const {
    EXPECT_THAT([this] { read_private_file(file_); }, ThrowsMessage<std::runtime_error>(HasSubstr(why)));
  }

  const mode_t before_;
  const TemporaryFolder folder_;
  const std::string file_ = folder_.file("map");
};

TEST_F(PrivateFile, ComesBackAsItWasWritten) {
  for (const std::size_t size : {0U, 1U, 65536U, 200000U}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * 7);
    replace_private_file(file_, bytes);
    EXPECT_EQ(read_private_file(file_), bytes);
  }
}

TEST_F(PrivateFile, IsReadByItsUserAlone) {
  replace_private_file(file_, "map");
  EXPECT_EQ(mode(), S_IFREG | 0600U);
}

TEST_F(PrivateFile, IsNotWrittenIntoWhatALinkPointsTo) {
  const std::string victim = folder_.file("victim");
  write_bytes(victim, {1});
  fs::create_symlink(victim, file_);
  fs::create_symlink(victim, file_ + ".new");
  replace_private_file(file_, "map");
  EXPECT_EQ(bytes_of(victim), std::vector<std::uint8_t>{1});
  EXPECT_EQ(mode(), S_IFREG | 0600U);
  EXPECT_EQ(read_private_file(file_), "map");
}

TEST_F(PrivateFile, IsNotWrittenThroughALinkThatStays) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  const std::string victim = folder_.file("victim");
  write_bytes(victim, {1});
  fs::permissions(victim, fs::perms{0666});
  fs::create_symlink(victim, file_ + ".new");
  const AsOther other;
  EXPECT_THAT([this] { replace_private_file(file_, "map"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot make")));
  EXPECT_EQ(bytes_of(victim), std::vector<std::uint8_t>{1});
}

TEST_F(PrivateFile, TakesThePlaceOfWhatACrashLeft) {
  write_bytes(file_ + ".new", {1, 2, 3, 4, 5});
  replace_private_file(file_, "map");
  EXPECT_EQ(read_private_file(file_), "map");
  EXPECT_FALSE(fs::exists(file_ + ".new"));
}

TEST_F(PrivateFile, OfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  replace_private_file(file_, "map");
  ASSERT_EQ(chown(file_.c_str(), kOther, 0), 0);
  expect_refusal("belongs to user 65534");
  const AsOther other;
  EXPECT_EQ(read_private_file(file_), "map");
}

TEST_F(PrivateFile, OfRootIsRead) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  replace_private_file(file_, "map");
  fs::permissions(file_, fs::perms{0644});
  const AsOther other;
  EXPECT_EQ(read_private_file(file_), "map");
}

TEST_F(PrivateFile, IsRefusedWhereItIsNoRegularFile) {
  expect_refusal("No such file");
  ASSERT_EQ(mkfifo(file_.c_str(), 0600), 0);
  expect_refusal("not a regular file");
  fs::remove(file_);
  fs::create_directory(file_);
  expect_refusal("not a regular file");
  fs::remove(file_);
  replace_private_file(folder_.file("elsewhere"), "map");
  fs::create_symlink(folder_.file("elsewhere"), file_);
  expect_refusal("is a link");
}

TEST_F(PrivateFile, IsNotSoughtWhereAnothersLinkLeads) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be two users";
  const std::string mine = folder_.file("mine"), planted = folder_.file("planted");
  fs::create_directory(mine);
  replace_private_file(mine + "/map", "before");
  fs::create_directory_symlink(mine, planted);
  EXPECT_EQ(read_private_file(planted + "/map"), "before") << "a link of one's own";
  ASSERT_EQ(lchown(planted.c_str(), kOther, 0), 0);
  const auto refuses = ThrowsMessage<std::runtime_error>(HasSubstr(planted + " is a link of user 65534"));
  EXPECT_THAT([&] { read_private_file(planted + "/map"); }, refuses);
  EXPECT_THAT([&] { replace_private_file(planted + "/map", "after"); }, refuses);
  EXPECT_EQ(read_private_file(mine + "/map"), "before");
}

TEST_F(PrivateFile, StaysAsItWasWhereItCanNotBeWritten) {
  EXPECT_THROW(replace_private_file(folder_.file("none/map"), "map"), std::runtime_error);
  replace_private_file(file_, "before");
  {
    const FileSizeLimit full_disk(3);
    EXPECT_THAT([this] { replace_private_file(file_, "too long"); },
                ThrowsMessage<std::runtime_error>(HasSubstr("cannot write")));
  }
  EXPECT_EQ(read_private_file(file_), "before");
}

}  // namespace
}  // namespace laneloom::snapshot
