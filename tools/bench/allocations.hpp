#pragma once

#include <cstdint>

/// Counts the memory that `new` gives out. A program that uses this has its own operators `new` and `delete`,
/// which count only within an AllocationScope. Over-aligned types, and memory that C libraries and Eigen's
/// dynamic matrices take from malloc() themselves, are left out.
namespace laneloom::bench {

/// The allocations within one or several scopes.
struct AllocationTally {
  std::uint64_t count = 0;      ///< calls of `new`
  std::int64_t bytes = 0;       ///< bytes still in use, as malloc rounds them
  std::int64_t peak_bytes = 0;  ///< the most that was in use at one time
};

/// Counts this thread's allocations into a tally while it lives. Scopes do not nest.
class AllocationScope {
 public:
  explicit AllocationScope(AllocationTally& tally);
  ~AllocationScope();
  AllocationScope(const AllocationScope&) = delete;
  AllocationScope& operator=(const AllocationScope&) = delete;
};

}  // namespace laneloom::bench
