// Of what nothing explains no part is singled out by what was chosen for being there.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::shares_of_excess_test {
namespace {

TEST(SharesOfExcess, OfWhatNothingExplainsPositionsShareTheExcessOfChiSquare) {
  // In the second recording an accelerometer reads 200 ug more: no effect of the library has its
  // constant anew in each recording.
  const mc::Study study = test::six_study();
  const Recording first = test::simulated(study);
  Recording second = first;
  for (double& x : test::channel(second, "acc_x")) x += 200e-6;
  DiagnoseOptions options;
  options.starts = 1;
  options.whiteness_draws = 0;
  options.proposing = Proposing::left_out;
  const Diagnosis d = diagnose(study, {first, second}, options);
  ASSERT_EQ(d.verdict, Verdict::unexplained);
  ASSERT_EQ(d.where.positions.size(), 6u);
  const auto excess = [](const Share& s) { return std::max(0.0, s.chi2_per_dof - 1.0); };
  double total = 0.0;  // positions have equally many rows
  for (const Share& s : d.where.positions) total += excess(s);
  ASSERT_GT(total, 0.0);
  for (const Share& s : d.where.positions)
    EXPECT_NEAR(s.share, excess(s) / total, 1e-9) << s.position;
}

TEST(SharesOfExcess, MostOfItIsMoreThanHalf) {
  Where where;
  where.equation = "accelerometer x";
  const auto says = [&](std::initializer_list<double> shares) {
    where.positions.clear();
    for (const double share : shares) {
      where.positions.push_back({.position = static_cast<int>(where.positions.size()) + 1});
      where.positions.back().share = share;
    }
    return report::where_sentence(where);
  };
  EXPECT_EQ(says({0.3, 0.25, 0.05}),
            "The misfit is in the accelerometer x, most of it at positions 1 (30 %) and 2 (25 %).");
  EXPECT_EQ(says({0.51, 0.09}),
            "The misfit is in the accelerometer x, most of it at position 1 (51 %).");
  EXPECT_EQ(says({0.27, 0.16, 0.09}),
            "The misfit is in the accelerometer x, the largest parts of it at positions 1 (27 %) "
            "and 2 (16 %).");
  EXPECT_EQ(says({0.4, 0.09}),
            "The misfit is in the accelerometer x, the largest part of it at position 1 (40 %).");
  EXPECT_EQ(says({0.08, 0.08}), "The misfit is in the accelerometer x.");
}

}  // namespace
}  // namespace drift::diagnosis::shares_of_excess_test
