#include "analysis/planning/greedy.hpp"

#include <gtest/gtest.h>

#include <set>

namespace drift::planning {
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
  bool better(int a, int b) const { return a > b; }
  bool take(std::size_t k, int gain) {
    if (gain == 0) return false;
    covered.insert(sets[k].begin(), sets[k].end());
    taken.push_back(k);
    return true;
  }
};

using Taken = std::vector<std::size_t>;

TEST(Greedy, TakesWhatAddsMostToWhatIsThereAndOfEqualsTheFirst) {
  // The third is the largest; then the second adds as much as the last and more than the first.
  const Cover start{{{1, 2, 3}, {7, 8}, {1, 2, 3, 4}, {8, 9}}};
  for (const int threads : {1, 3}) {
    Cover cover = start;
    grow_greedily(cover, 2, threads);
    EXPECT_EQ(cover.taken, (Taken{2, 1}));
  }
}

TEST(Greedy, EndsWhereNothingIsWorthItOrThereIsNothing) {
  Cover cover{{{1, 2}, {2}}};
  std::vector<std::size_t> steps;
  grow_greedily(cover, 5, 1, [&](std::size_t done, std::size_t most) {
    EXPECT_EQ(most, 5u);
    steps.push_back(done);
  });
  EXPECT_EQ(cover.taken, (Taken{0}));
  EXPECT_EQ(steps, (Taken{1}));
  Cover none;
  grow_greedily(none, 5, 1);
  EXPECT_TRUE(none.taken.empty());
}

}  // namespace
}  // namespace drift::planning
