#pragma once

#include <omp.h>

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <vector>

namespace drift::mc {

/// Threads that campaigns begun on this thread use while it lives, unless they are told; 0: as
/// before.
class ThreadCount {
 public:
  explicit ThreadCount(int threads) : before_(omp_get_max_threads()) {
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadCount() { omp_set_num_threads(before_); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_;
};

/// Calls task(i) for i = 0..n-1 on all OpenMP threads and returns the results in order. The result
/// does not depend on the number of threads as long as task(i) depends on i alone. No exception
/// leaves a thread: the one of the lowest index is rethrown when all are done.
template <class Task>
auto run_campaign(std::size_t n, Task&& task, int threads = 0)
    -> std::vector<decltype(task(std::size_t{0}))> {
  std::vector<decltype(task(std::size_t{0}))> results(n);
  std::exception_ptr first;
  std::size_t first_index = n;
  std::mutex guard;
#pragma omp parallel for schedule(dynamic) \
    num_threads(threads > 0 ? threads : omp_get_max_threads())
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(n); ++i) {
    const auto k = static_cast<std::size_t>(i);
    try {
      results[k] = task(k);
    } catch (...) {
      const std::scoped_lock lock(guard);
      if (k < first_index) {
        first_index = k;
        first = std::current_exception();
      }
    }
  }
  if (first) std::rethrow_exception(first);
  return results;
}

}  // namespace drift::mc
