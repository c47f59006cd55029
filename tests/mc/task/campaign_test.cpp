// Independent tasks over threads.
#include "mc/task/campaign.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>

namespace drift::campaign_test {
namespace {

TEST(Campaign, OfOneThreadSpreadsNothingWithinItsTasks) {
  // `--threads 1` was heeded outside alone: what a task spread in turn went over all processors.
  const mc::ThreadCount many(4);
  std::set<std::thread::id> seen;
  std::mutex guard;
  mc::for_each_index(
      3,
      [&](std::size_t) {
        EXPECT_EQ(mc::usual_threads(), 1);
        mc::for_each_index(8, [&](std::size_t) {
          const std::scoped_lock lock(guard);
          seen.insert(std::this_thread::get_id());
        });
      },
      1);
  EXPECT_EQ(seen, std::set{std::this_thread::get_id()});
  EXPECT_EQ(mc::usual_threads(), 4) << "as before, once they are done";
}

TEST(Campaign, OfOneTaskLeavesItAllThreads) {
  const mc::ThreadCount many(3);
  mc::for_each_index(1, [](std::size_t) { EXPECT_EQ(mc::usual_threads(), 3); });
}

TEST(Campaign, ThrowsWhatTheFirstOfTheFailedTasksThrew) {
  for (const int threads : {1, 4}) {
    std::atomic<int> done = 0;
    try {
      mc::for_each_index(
          40,
          [&](std::size_t k) {
            ++done;
            if (k % 10 == 7) throw std::runtime_error(std::to_string(k));
          },
          threads);
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "7");
    }
    EXPECT_EQ(done, 40) << "the others are not left undone";
  }
}

}  // namespace
}  // namespace drift::campaign_test
