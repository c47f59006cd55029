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

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& task, int threads) {
  std::exception_ptr first;
  std::size_t first_index = n;
  std::mutex guard;
  if (threads <= 0) threads = usual_threads();
  if (n < static_cast<std::size_t>(threads)) threads = std::max(1, static_cast<int>(n));
  require_threads(threads);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(n); ++i) {
    const auto k = static_cast<std::size_t>(i);
    try {
      task(k);
    } catch (...) {
      const std::scoped_lock lock(guard);
      if (k < first_index) {
        first_index = k;
        first = std::current_exception();
      }
    }
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace drift::mc
