#pragma once

#include <atomic>
#include <cstdlib>

/// Calls of malloc of this program so far. Included by one source of a program.
namespace {
std::atomic<long> allocations{0};
}

// glibc's own entry points carry the work; these only count.
extern "C" void* __libc_malloc(std::size_t) noexcept;
extern "C" void* malloc(std::size_t n) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(n);
}
