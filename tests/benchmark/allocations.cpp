#include "tests/benchmark/allocations.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

// Stands before the C library's allocator, which new, containers and Eigen all end in.

namespace {

std::atomic<int64_t> num_allocations{0};

void Count() { num_allocations.fetch_add(1, std::memory_order_relaxed); }

}  // namespace

extern "C" {

void* __libc_malloc(size_t size);
void* __libc_calloc(size_t num, size_t size);
void* __libc_realloc(void* block, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) noexcept {
  Count();
  return __libc_malloc(size);
}

void* calloc(size_t num, size_t size) noexcept {
  Count();
  return __libc_calloc(num, size);
}

void* realloc(void* block, size_t size) noexcept {
  Count();
  return __libc_realloc(block, size);
}

void* aligned_alloc(size_t alignment, size_t size) noexcept {
  Count();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, size_t alignment, size_t size) noexcept {
  Count();
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
}

namespace declutter::benchmark {

int64_t NumAllocations() { return num_allocations.load(std::memory_order_relaxed); }

}  // namespace declutter::benchmark
