#include "bench/allocations.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace laneloom::bench {
namespace {

thread_local AllocationTally* current = nullptr;

void* allocate(std::size_t size) {
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (current == nullptr || memory == nullptr) return memory;
  ++current->count;
  current->bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
  current->peak_bytes = std::max(current->peak_bytes, current->bytes);
  return memory;
}

void* allocate_or_throw(std::size_t size) {
  if (void* memory = allocate(size)) return memory;
  throw std::bad_alloc();
}

void release(void* memory) {
  if (current != nullptr && memory != nullptr)
    current->bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

AllocationScope::AllocationScope(AllocationTally& tally) { current = &tally; }
AllocationScope::~AllocationScope() { current = nullptr; }

}  // namespace laneloom::bench

// Every form is defined, because sanitizers bring their own of those that are left out.
void* operator new(std::size_t size) { return laneloom::bench::allocate_or_throw(size); }
void* operator new[](std::size_t size) { return laneloom::bench::allocate_or_throw(size); }
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return laneloom::bench::allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return laneloom::bench::allocate(size);
}
void operator delete(void* memory) noexcept { laneloom::bench::release(memory); }
void operator delete[](void* memory) noexcept { laneloom::bench::release(memory); }
void operator delete(void* memory, std::size_t /*size*/) noexcept { laneloom::bench::release(memory); }
void operator delete[](void* memory, std::size_t /*size*/) noexcept { laneloom::bench::release(memory); }
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept {
  laneloom::bench::release(memory);
}
void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept {
  laneloom::bench::release(memory);
}
