#include "mc/task/campaign.hpp"

#include <omp.h>

#include <exception>
#include <mutex>

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

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& task, int threads) {
  std::exception_ptr first;
  std::size_t first_index = n;
  std::mutex guard;
#pragma omp parallel for schedule(dynamic) num_threads(threads > 0 ? threads : usual_threads())
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
