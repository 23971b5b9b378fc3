#pragma once

#include <cstdint>

/// Counts what `new` gives out. A program that uses this has operators `new` and `delete` that look at one
/// thread-local pointer; only within a scope do they count. Over-aligned types, and what C libraries and
/// Eigen's dynamic matrices take from malloc() themselves, are left out.
namespace laneloom {

/// Of one or several scopes.
struct AllocationTally {
  std::uint64_t count = 0;      ///< calls of `new`
  std::int64_t bytes = 0;       ///< still in use, as malloc rounds them
  std::int64_t peak_bytes = 0;  ///< the most that was in use at one time
};

/// While it lives, this thread's allocations go into the tally. Scopes do not nest.
class AllocationScope {
 public:
  explicit AllocationScope(AllocationTally& tally);
  ~AllocationScope();
  AllocationScope(const AllocationScope&) = delete;
  AllocationScope& operator=(const AllocationScope&) = delete;
};

}  // namespace laneloom
