#include "analysis/planning/choose_additions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace drift::planning::choose_additions_test {
namespace {

/// Information on one nominal parameter and two signatures.
Information information(double tt, const Eigen::Vector2d& te, double e11, double e12, double e22) {
  Information info{MatX::Constant(1, 1, tt), te.transpose(), MatX(2, 2)};
  info.ee << e11, e12, e12, e22;
  return info;
}

Trace trace(int column, double amplitude) {
  return {{column}, VecX::Constant(1, amplitude)};
}

TEST(Separation, IsThatOfTwoLinesInTheSpaceOfMeasurements) {
  // Nothing is shared with the nominal parameter. Signature vectors of lengths 3 and 2 at 60 deg:
  // an amplitude of 5 is 15 long; free of prior, the rival takes all but the sine of it.
  const Information info = information(4.0, {0.0, 0.0}, 9.0, 3.0, 4.0);
  const std::vector<Trace> traces{trace(0, 5.0), trace(1, 1.0), {}};
  const std::vector<Contest> pairs{{0, 1}, {0, 2}};
  const auto apart = separations(info, traces, pairs);
  EXPECT_NEAR(apart[0].alone, 15.0, 1e-12);
  EXPECT_NEAR(apart[0].unlike, 0.75, 1e-12);  // sine squared of 60 deg
  // Its own prior costs the rival: 9 - 3^2 / (4 + 1).
  EXPECT_NEAR(apart[0].sigma, 5.0 * std::sqrt(9.0 - 9.0 / 5.0), 1e-12);
  EXPECT_NEAR(apart[1].sigma, 15.0, 1e-12);
  EXPECT_NEAR(apart[1].unlike, 1.0, 1e-12);
}

TEST(Separation, CountsOnlyWhatTheNominalParametersLeave) {
  // Information 8 with a prior of 1 makes 9; the cross term 6 takes 36 / 9 of the signature's 5.
  const Information info = information(8.0, {6.0, 0.0}, 5.0, 0.0, 1.0);
  const std::vector<Trace> traces{trace(0, 2.0), {}};
  const std::vector<Contest> pairs{{0, 1}};
  const Separation s = separations(info, traces, pairs).front();
  EXPECT_NEAR(s.sigma, 2.0, 1e-12);
  EXPECT_NEAR(s.unlike, 1.0 / 5.0, 1e-12);
}

Candidate<Information> candidate(double dwell, double e11, double e22) {
  Position p;
  p.dwell = dwell;
  return {{p}, information(0.0, {0.0, 0.0}, e11, 0.0, e22)};
}

/// Two effects of one sigma each against the nominal model.
std::vector<std::size_t> chosen(const std::vector<Candidate<Information>>& pool, std::size_t most,
                                double wanted) {
  const std::vector<Trace> traces{trace(0, 1.0), trace(1, 1.0), {}};
  const std::vector<Contest> pairs{{0, 2}, {1, 2}};
  return choose_additions(information(0.0, {0.0, 0.0}, 0.0, 0.0, 0.0), pool,
                          {traces, pairs, most, wanted});
}

using Indices = std::vector<std::size_t>;

TEST(ChooseAdditions, AddsWhatIsMissingNotWhatIsAlreadySeen) {
  const std::vector<Candidate<Information>> pool{
      candidate(60.0, 64.0, 0.0), candidate(60.0, 60.0, 0.0), candidate(60.0, 0.0, 16.0)};
  EXPECT_EQ(chosen(pool, 2, 8.0), (Indices{0, 2}));     // the second adds nothing beyond `wanted`
  EXPECT_EQ(chosen(pool, 3, 8.0), (Indices{0, 2, 2}));  // and a position may be held twice
}

TEST(ChooseAdditions, TakesTheShorterWhereBothReachTheAimUnlessTheMarginIsCheap) {
  // All that is wanted (8 sigma of each) in 60 s, or by one addition of 90 s.
  EXPECT_EQ(chosen({candidate(60.0, 64.0, 64.0), candidate(90.0, 65.0, 65.0)}, 3, 8.0),
            (Indices{0}));
  // 20 sigma in less than twice the time is a margin that is cheap; in more it is not.
  EXPECT_EQ(chosen({candidate(60.0, 64.0, 64.0), candidate(110.0, 400.0, 400.0)}, 3, 8.0),
            (Indices{1}));
  EXPECT_EQ(chosen({candidate(60.0, 64.0, 64.0), candidate(130.0, 400.0, 400.0)}, 3, 8.0),
            (Indices{0}));
}

TEST(ChooseAdditions, AMarginIsTwiceAsFarInNoMoreThanTwiceTheTime) {
  const auto longer = [](double sigma, double dwell) {
    return chosen({candidate(60.0, 81.0, 81.0), candidate(dwell, sigma * sigma, sigma * sigma)}, 3,
                  8.0) == Indices{1};
  };
  EXPECT_FALSE(longer(17.9, 90.0));
  EXPECT_TRUE(longer(18.1, 90.0));
  EXPECT_TRUE(longer(18.1, 120.0));
  EXPECT_FALSE(longer(18.1, 126.0));
}

TEST(ChooseAdditions, EightSigmaAreEnough) {
  // Six minutes that reach it are enough; if not, six more are, and no hour is needed.
  const auto short_one = [](double sigma) {
    const Aim aim;
    return chosen({candidate(3600.0, 81.0, 81.0), candidate(360.0, sigma * sigma, sigma * sigma)},
                  aim.most, aim.wanted);
  };
  EXPECT_EQ(short_one(8.1), Indices{1});
  EXPECT_EQ(short_one(7.9), (Indices{1, 1}));
}

TEST(ChooseAdditions, IsNothingWhereNothingHelps) {
  EXPECT_TRUE(chosen({candidate(60.0, 0.0, 0.0)}, 3, 8.0).empty());
  EXPECT_TRUE(choose_additions(information(0.0, {0.0, 0.0}, 0.0, 0.0, 0.0), {}, {}).empty());
}

}  // namespace
}  // namespace drift::planning::choose_additions_test
