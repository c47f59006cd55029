// Which pairs of causes stand against a single one that explains a test.
#include "analysis/search/promising.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/white_problem.hpp"

namespace drift::search::promising_test {
namespace {

/// Two effects of so many sigmas each, of orthogonal traces, and a third that is alike to 0.95 of
/// their sum; beside forty that leave no trace.
Search of_two(double sigmas) {
  const MatX traces{{1.0, 0.0, 0.95 / std::sqrt(2.0)},
                    {0.0, 1.0, 0.95 / std::sqrt(2.0)},
                    {0.0, 0.0, std::sqrt(1.0 - 0.95 * 0.95)}};
  constexpr double unit = 100.0;  // a prior sigma is a hundred of the data's
  const VecX r{{sigmas, sigmas, 0.0}};
  constexpr int terms = 43;
  MatX all = MatX::Zero(3, terms);
  all.leftCols<3>() = unit * traces;
  inference::CandidateSet set;
  for (int k = 0; k < terms; ++k)
    set.candidates.push_back(
        {"term" + std::to_string(k), "", "", {static_cast<std::size_t>(k)}, {{{k}, {}}}});
  Search s{};
  static_cast<Field&>(s.nominal) =
      Field(std::move(set),
            inference::Projector(test::white_problem(MatX(3, 0), all, r), {}).candidates(), {});
  for (std::size_t k = 0; k < terms; ++k) s.nominal.scores.push_back(score(s.nominal, k));
  s.thresholds.library_threshold = s.thresholds.scan_threshold = HUGE_VAL;
  return s;
}

std::vector<Explanation> against_third(const Search& s, double log_bayes) {
  Refit single;
  single.choices = {{2, 0}};
  single.log_bayes = log_bayes;
  return pairs_against(s, single, 6);
}

TEST(PairsAgainst, AreThoseThatMayBeAsProbableAsWhatExplainsTheTestAlone) {
  // 10 sigma each: the third has 0.95^2 of 200, the two have all of it, 9.75 more of half the log.
  const Search strong = of_two(10.0);
  const auto pairs = against_third(strong, strong.nominal.scores[2].log_bayes);
  ASSERT_FALSE(pairs.empty());
  EXPECT_TRUE(same_causes(pairs.front(), {{0, 0}, {1, 0}}) ||
              same_causes(pairs.front(), {{1, 0}, {0, 0}}));
  // 2 sigma each: 0.4 more, which no second cause is worth.
  const Search weak = of_two(2.0);
  EXPECT_TRUE(against_third(weak, weak.nominal.scores[2].log_bayes).empty());
}

TEST(PairsAgainst, AreNoneWhereTheFitOfOneDoesBetterThanItsLinearTest) {
  const Search strong = of_two(10.0);
  EXPECT_TRUE(against_third(strong, 0.5 * 200.0 + 10.0).empty());
}

TEST(PairsAgainst, TheOtherEquationIsNoneOfThem) {
  Search s = of_two(10.0);
  s.nominal.set.candidates[0].term = closure_term;
  for (const Explanation& pair : against_third(s, s.nominal.scores[2].log_bayes))
    for (const Choice& c : pair) EXPECT_NE(c.candidate, 0u);
  s.nominal.set.candidates[2].term = closure_term;
  EXPECT_TRUE(against_third(s, 0.0).empty());
}

}  // namespace
}  // namespace drift::search::promising_test
