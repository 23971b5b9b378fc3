#include "bench/allocations.hpp"

#include <gtest/gtest.h>

#include <new>
#include <thread>

namespace laneloom::bench {
namespace {

// Called as functions, operators `new` and `delete` are never optimised away.
TEST(Allocations, CountsWhatIsGivenOutWithinTheScope) {
  AllocationTally tally;
  void* before = ::operator new(1000);
  void* kept = nullptr;
  {
    const AllocationScope counting(tally);
    kept = ::operator new(5000);
    for (int i = 0; i < 7; ++i) ::operator delete(::operator new(2000));
    ::operator delete[](::operator new[](10, std::nothrow), std::nothrow);
  }
  void* after = ::operator new(9000);
  EXPECT_EQ(tally.count, 9U);
  // malloc gives a little more than it is asked for.
  EXPECT_GE(tally.bytes, 5000);
  EXPECT_LT(tally.bytes, 6000);
  EXPECT_GE(tally.peak_bytes, 7000);
  EXPECT_LT(tally.peak_bytes, 8500);
  for (void* memory : {before, kept, after}) ::operator delete(memory);
}

TEST(Allocations, AddsUpOverScopes) {
  AllocationTally tally;
  void* memory = nullptr;
  {
    const AllocationScope counting(tally);
    memory = ::operator new(3000);
  }
  {
    const AllocationScope counting(tally);
    ::operator delete(memory);
  }
  EXPECT_EQ(tally.count, 1U);
  EXPECT_EQ(tally.bytes, 0);
  EXPECT_GE(tally.peak_bytes, 3000);
}

TEST(Allocations, OfOtherThreadsAreNotCounted) {
  AllocationTally tally;
  std::jthread other;
  {
    const AllocationScope counting(tally);
    ::operator delete(::operator new(10));
    other = std::jthread([] {
      for (int i = 0; i < 1000; ++i) ::operator delete(::operator new(10));
    });
    other.join();
  }
  EXPECT_GE(tally.count, 1U);
  EXPECT_LT(tally.count, 100U);  // std::jthread has some of its own
}

}  // namespace
}  // namespace laneloom::bench
