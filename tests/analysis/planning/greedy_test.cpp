#include "analysis/planning/greedy.hpp"

#include <gtest/gtest.h>

#include <set>

namespace drift::planning::greedy_test {
namespace {

/// Sets of numbers; the merit of one is how many it adds to what is there.
struct Cover {
  std::vector<std::set<int>> sets;
  std::set<int> covered = {};
  std::vector<std::size_t> taken = {};

  std::size_t candidates() { return sets.size(); }
  int merit(std::size_t k) const {
    std::set<int> with = covered;
    with.insert(sets[k].begin(), sets[k].end());
    return static_cast<int>(with.size() - covered.size());
  }
  bool take(std::size_t k, int gain) {
    if (gain == 0) return false;
    covered.insert(sets[k].begin(), sets[k].end());
    taken.push_back(k);
    return true;
  }
};

using Taken = std::vector<std::size_t>;

void cover_greedily(Cover& cover, std::size_t most, int threads) {
  take_greedily(
      most, [&] { return cover.candidates(); }, [&](std::size_t k) { return cover.merit(k); },
      [&](std::size_t k, int gain) { return cover.take(k, gain); }, threads);
}

TEST(Greedy, TakesWhatAddsMostToWhatIsThereAndOfEqualsTheFirst) {
  // The third is the largest; then the second adds as much as the last and more than the first.
  const Cover start{{{1, 2, 3}, {7, 8}, {1, 2, 3, 4}, {8, 9}}};
  for (const int threads : {1, 3}) {
    Cover cover = start;
    cover_greedily(cover, 2, threads);
    EXPECT_EQ(cover.taken, (Taken{2, 1}));
  }
}

TEST(Greedy, EndsWhereNothingIsWorthItOrThereIsNothing) {
  Cover cover{{{1, 2}, {2}}};
  cover_greedily(cover, 5, 1);
  EXPECT_EQ(cover.taken, (Taken{0}));
  Cover none;
  cover_greedily(none, 5, 1);
  EXPECT_TRUE(none.taken.empty());
}

}  // namespace
}  // namespace drift::planning::greedy_test
