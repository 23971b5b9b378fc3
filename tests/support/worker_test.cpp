#include "support/worker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>
#include <vector>

namespace laneloom::support {
namespace {

TEST(Worker, DoesJobsInTheirOrderOnAnotherThread) {
  std::vector<int> done;
  Worker worker;
  for (int i = 0; i < 100; ++i)
    worker.add([&done, i, giver = std::this_thread::get_id()] {
      if (std::this_thread::get_id() != giver) done.push_back(i);
    });
  worker.finish();
  ASSERT_EQ(done.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(done));
  worker.add([&] { done.clear(); });
  worker.finish();
  EXPECT_THAT(done, testing::IsEmpty());
}

TEST(Worker, TellsWhatAJobHasThrownAndDoesNoMore) {
  bool done = false;
  Worker worker;
  worker.add([] { throw std::runtime_error("disk full"); });
  EXPECT_THROW(worker.finish(), std::runtime_error);
  EXPECT_THROW(worker.add([&] { done = true; }), std::runtime_error);
  EXPECT_THROW(worker.finish(), std::runtime_error);
  EXPECT_FALSE(done);
}

TEST(Worker, LetsWhoeverGivesTooMuchWait) {
  std::promise<void> may_go_on;
  std::atomic<std::size_t> given = 0;
  std::size_t given_meanwhile = 0;
  Worker worker;
  worker.add([&] {
    may_go_on.get_future().wait();
    given_meanwhile = given;
  });
  std::jthread giver([&] {
    for (; given < 1000; ++given) worker.add([] {});
  });
  while (given + 1 < Worker::kMostJobs) std::this_thread::yield();
  may_go_on.set_value();
  giver.join();
  worker.finish();
  EXPECT_LT(given_meanwhile, Worker::kMostJobs);
}

TEST(Worker, EndsWhileJobsWait) {
  std::promise<void> may_end;
  Worker worker;
  worker.add([&] { may_end.get_future().wait(); });
  worker.add([] {});
  may_end.set_value();
}

}  // namespace
}  // namespace laneloom::support
