#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace drift::mc {

/// Threads that work begun on this thread uses where it is not told: all processors, until a
/// ThreadCount says otherwise.
int usual_threads();

/// Makes another number of threads the usual one while it lives; 0: as before.
class ThreadCount {
 public:
  explicit ThreadCount(int threads);
  ~ThreadCount();
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_;
};

/// Looks whether the system gives the program so many threads at the same time: what runs them ends
/// the whole program where it does not. InputError (usage) says how many it gives.
void require_threads(int threads);

/// Calls task(i) for i = 0..n-1 on several threads (0: the usual number). No exception leaves a
/// thread: the one of the lowest index is rethrown when all are done.
void for_each_index(std::size_t n, const std::function<void(std::size_t)>& task, int threads = 0);

/// The results of task(0), ..., task(n-1), in order, worked out on several threads. They do not
/// depend on the number of threads as long as task(i) depends on i alone.
template <class Task>
auto run_campaign(std::size_t n, Task&& task, int threads = 0)
    -> std::vector<decltype(task(std::size_t{0}))> {
  std::vector<decltype(task(std::size_t{0}))> results(n);
  for_each_index(
      n, [&](std::size_t k) { results[k] = task(k); }, threads);
  return results;
}

}  // namespace drift::mc
