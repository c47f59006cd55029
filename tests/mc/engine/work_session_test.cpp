#include "mc/engine/work_session.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <set>
#include <thread>

namespace drift::mc::work_session_test {
namespace {

TEST(WorkSession, PartsOfAnyNumberOfWorkersAreAllJobsOnce) {
  for (std::size_t n : {0u, 1u, 7u, 64u})
    for (std::size_t count : {1u, 2u, 3u, 8u, 100u}) {
      std::multiset<std::size_t> seen;
      for (std::size_t i = 0; i < count; ++i)
        for (const std::size_t k : own_part(n, {i, count})) seen.insert(k);
      EXPECT_EQ(seen.size(), n);
      EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), n);
    }
}

TEST(WorkSession, AWorkerThatWaitsForNobodyTakesItsPartFirstAndThenAllOthers) {
  const WorkerShare share{1, 3};
  const auto all = own_part_first(10, share), own = own_part(10, share);
  EXPECT_TRUE(std::equal(own.begin(), own.end(), all.begin()));
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), 10u);
  EXPECT_EQ(all.size(), 10u);
  EXPECT_EQ(all[own.size()], 8u) << "those of worker 2 from their end";
}

TEST(WorkSession, WhereTheTimeIsOverOneIsDoneAndWhatIsAtWorkIsFinished) {
  std::vector<std::size_t> jobs(50);
  std::iota(jobs.begin(), jobs.end(), 0);
  std::atomic<int> done{0};
  work_through(jobs, {2, {}, WallTime(0.0)}, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 1) << "however short the time, the same call comes to an end";
  work_through(jobs, {2, {}, WallTime(0.05)}, [&](std::size_t) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    ++done;
  });
  EXPECT_GE(done, 2);
  EXPECT_LT(done, 50);
  done = 0;
  work_through(jobs, {2}, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 50);
}

}  // namespace
}  // namespace drift::mc::work_session_test
