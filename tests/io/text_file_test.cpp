#include "io/text_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>

#include "temporary_folder.hpp"

namespace laneloom::io {
namespace {

/// No file can grow as long as this, as on a full disk.
class FullDisk {
 public:
  FullDisk() {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit nothing{.rlim_cur = 0, .rlim_max = before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &nothing);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
};

TEST(TextFile, OnAFullDiskNoFileStaysBehind) {
  const TemporaryFolder folder;
  {
    const FullDisk full;
    EXPECT_THROW(write_text(folder.file("table.json"), "{}"), std::runtime_error);
  }
  EXPECT_FALSE(std::filesystem::exists(folder.file("table.json")));
}

}  // namespace
}  // namespace laneloom::io
