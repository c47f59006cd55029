#include "mc/task/campaign.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <exception>
#include <latch>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/check.hpp"

namespace drift::mc {

int usual_threads() {
  return omp_get_max_threads();
}

ThreadCount::ThreadCount(int threads) : before_(usual_threads()) {
  if (threads > 0) omp_set_num_threads(threads);
}

ThreadCount::~ThreadCount() {
  omp_set_num_threads(before_);
}

void require_threads(int threads) {
  static std::mutex guard;
  static int granted = 1;
  const std::scoped_lock lock(guard);
  if (threads <= granted) return;
  std::latch together(1);  // so that all are there at the same time
  std::vector<std::jthread> all;
  std::string reason;
  try {
    while (static_cast<int>(all.size()) + 1 < threads)
      all.emplace_back([&together] { together.wait(); });
  } catch (const std::system_error& e) {
    reason = e.code().message();
  } catch (const std::bad_alloc&) {
    reason = "no memory for them";
  }
  const std::size_t got = all.size() + 1;
  together.count_down();
  all.clear();
  if (!reason.empty())
    throw InputError(
        ExitCode::usage,
        fmt::format("--threads {}: the system gives this program no more than {} threads: {} "
                    "(expected as many as are asked for). Ask for fewer, or raise the limits "
                    "(ulimit -u, ulimit -v, the memory or the tasks of the job)",
                    threads, got, reason));
  granted = threads;
}

namespace {

/// The exception of the lowest index among those that tasks threw.
class FirstException {
 public:
  void run(const std::function<void(std::size_t)>& task, std::size_t k) {
    try {
      task(k);
    } catch (...) {
      const std::scoped_lock lock(guard_);
      if (exception_ && k >= index_) return;
      index_ = k;
      exception_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex guard_;
  std::size_t index_ = 0;
  std::exception_ptr exception_;
};

}  // namespace

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& task, int threads) {
  const ThreadCount told(threads);  // what tasks spread in turn uses no more than was asked for
  threads = usual_threads();
  FirstException first;
  if (n <= 1 || threads == 1 || omp_in_parallel()) {
    for (std::size_t k = 0; k < n; ++k) first.run(task, k);
  } else {
    threads = static_cast<int>(std::min(n, static_cast<std::size_t>(threads)));
    require_threads(threads);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(n); ++i)
      first.run(task, static_cast<std::size_t>(i));
  }
  first.rethrow();
}

}  // namespace drift::mc
