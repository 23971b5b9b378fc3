#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <thread>

#include "temporary_folder.hpp"

namespace laneloom::support {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::ThrowsMessage;

class Child : public testing::Test {
 protected:
  /// The answer of stop() for a shell that runs this. The shell is told to end once it has printed something.
  std::string stop(const std::string& script, milliseconds patience = std::chrono::seconds(10)) {
    ChildProcess child({"/bin/sh", "-c", script}, output_);
    while (std::ifstream(output_).peek() == EOF) std::this_thread::sleep_for(milliseconds(5));
    return child.stop(patience);
  }

  const TemporaryFolder folder_;
  const std::string output_ = folder_.file("output");
};

TEST_F(Child, AnOrderlyEndIsNoFailure) {
  EXPECT_EQ(stop("trap 'exit 0' TERM; echo; while :; do sleep 0.01; done"), "");
}

TEST_F(Child, ACrashOnTheWayOutIsAFailure) {
  EXPECT_EQ(stop("trap 'kill -SEGV $$' TERM; echo; while :; do sleep 0.01; done"), "ended by signal 11");
  EXPECT_EQ(stop("trap 'exit 3' TERM; echo; while :; do sleep 0.01; done"), "ended with exit code 3");
}

TEST_F(Child, WhatDoesNotEndIsKilled) {
  EXPECT_EQ(stop("trap '' TERM; echo; while :; do sleep 0.01; done", milliseconds(100)),
            "did not end within 100 ms, and was killed");
}

TEST_F(Child, WhatHadEndedBeforeIsAFailure) {
  ChildProcess child({"/bin/true"}, output_);
  while (child.running()) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_EQ(child.failure(), "");
  EXPECT_EQ(child.stop(), "had ended before");
}

TEST_F(Child, AProgramThatCannotBeExecutedIsNamedAtOnce) {
  EXPECT_THAT([&] { ChildProcess({"/nowhere/program"}, output_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/program: cannot be started: No such")));
}

}  // namespace
}  // namespace laneloom::support
