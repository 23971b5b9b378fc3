#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "faults.hpp"
#include "temporary_folder.hpp"

// A service whose files lie where it may not write; deploy/README.md, "When things go wrong".
namespace laneloom {
namespace {

class ReadOnlyFolder : public Faults {
 protected:
  void SetUp() override {
    write("service:\n  snapshot_period_s: 0.1\n");
    // Root may write whatever the permissions say, but not into such a mount.
    started_by_ = {"/usr/bin/unshare",
                   "--mount",
                   "/bin/sh",
                   "-c",
                   "mount --bind \"$0\" \"$0\" && mount -o remount,bind,ro \"$0\" && exec \"$@\"",
                   folder_.path()};
    if (outcome_of({"/bin/true"}) != 0) GTEST_SKIP() << "no mounts may be made here";
    ASSERT_NE(outcome_of({"/usr/bin/touch", config_file_}), 0) << "the folder can be written into";
  }
  /// From without.
  void write(const std::string& text) const { std::ofstream(config_file_) << text; }
  std::optional<int> outcome_of(const std::vector<std::string>& command) const {
    auto words = started_by_;
    words.insert(words.end(), command.begin(), command.end());
    return Process(words).wait();
  }

  const TemporaryFolder folder_;
  const std::string config_file_ = folder_.file("laneloomd.yaml");
};

TEST_F(ReadOnlyFolder, IsEnoughForTheConfiguration) {
  start(100, {"--config", config_file_});
  write("service:\n  log_level: debug\n");
  service_->signal(SIGHUP);
  EXPECT_TRUE(service_->wait_for_error("event=changed key=service.log_level value=debug"))
      << service_->errors();
  EXPECT_TRUE(service_->wait_for_error("event=reopened")) << service_->errors();
  EXPECT_TRUE(is_good_again(10)) << "the senders did not find the new endpoints";
}

TEST_F(ReadOnlyFolder, TakesNoSnapshotAndTheServiceSaysSo) {
  start(100, {"--config", config_file_, "--snapshot", folder_.file("snapshot")});
  EXPECT_TRUE(rises("snapshots_failed", counters()));
  const std::string reason = folder_.file("snapshot") + ".new: Read-only file system";
  EXPECT_NE(service_->errors().find("error event=snapshot_failed why=\"cannot make " + reason),
            std::string::npos)
      << service_->errors();
  EXPECT_TRUE(stays_good(10));
}

}  // namespace
}  // namespace laneloom
