#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mc/task/campaign.hpp"

namespace drift::mc {

/// Which part of the work a worker takes: the jobs whose number is index modulo count. The part
/// does not depend on when the worker starts, so that nothing falls between two workers.
struct WorkerShare {
  std::size_t index = 0, count = 1;
  bool has(std::uint64_t job) const { return job % count == index; }
};

/// The numbers of a worker's part of n jobs.
std::vector<std::size_t> own_part(std::size_t n, const WorkerShare& share);

/// All n jobs in the order in which a worker takes them that waits for nobody: its own part, then
/// those of the others, each from its end, towards its owner.
std::vector<std::size_t> own_part_first(std::size_t n, const WorkerShare& share);

/// The time that a session may take by the clock, from when this is made.
class WallTime {
 public:
  explicit WallTime(std::optional<double> seconds = {}) : seconds_(seconds) {}
  bool is_over() const {
    return seconds_ &&
           std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count() >=
               *seconds_;
  }

 private:
  std::optional<double> seconds_;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

/// How one process works at jobs that several may share and that are resumed by the same call.
struct WorkSession {
  int threads = 0;  ///< 0: all
  WorkerShare share = {};
  WallTime time = WallTime();
};

/// Calls job(k) for the jobs of a list on the threads of a session, until its time is over: jobs at
/// work are finished then, no other is begun. One is done however short the time, so that the same
/// call, again and again, comes to an end. The exception of the first in the list is rethrown when
/// all are done.
template <class Job>
void work_through(const std::vector<std::size_t>& jobs, const WorkSession& session, Job&& job) {
  std::atomic<bool> begun{false};
  run_campaign(
      jobs.size(),
      [&](std::size_t i) {
        if (const bool first = !begun.exchange(true); first || !session.time.is_over())
          job(jobs[i]);
        return 0;
      },
      session.threads);
}

}  // namespace drift::mc
