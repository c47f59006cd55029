// Where an own term is no finite number along a plan, and where it only looks like it.
#include "core/sim/own_term_gaps.hpp"

#include <gtest/gtest.h>

#include "core/physics/expression/evaluate.hpp"
#include "core/physics/expression/range.hpp"
#include "tests/support/own_terms.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::own_term_gaps_test {
namespace {

using namespace drift::test;

/// A model of all own terms.
ModelSpec own_model() {
  ModelSpec model;
  for (const OwnTerm& term : own_terms().terms) model.active |= params_named(term.key);
  for (std::size_t i = 0; i < TermLibrary::specs.size(); ++i)
    model.priors[i] = TermLibrary::specs[i].prior_si();
  return model;
}

std::vector<OwnTermGap> gaps_of(const std::string& equation, const Timeline& timeline) {
  const OwnTermsHeld held(
      own_term("own", "drift.x", equation, "A = { unit = 'deg/h', prior = 0.05 }"));
  return own_term_gaps(timeline, own_model());
}

/// Six caged positions of 20 minutes, rows every 60 s, nodes every 30 s.
Timeline six() {
  return preset_timeline("six", CommandLaw::free, 1200.0, 60.0);
}

TEST(OwnTermGaps, APoleIsFoundAtARowAndBetweenRows) {
  const std::tuple<const char*, double, double> cases[] = {
      {"A/(t - 660)", 660.0, 660.0},
      {"A/(t - 610)", 610.0, 610.0},
      {"A/(t - 617.3)^2", 617.3, 617.3},
      {"A/abs(t - 1999.9)", 1999.9, 1999.9},
      {"A*tan((t - 700)/100)", 700.0 - 150.0 * M_PI, 700.0 - 150.0 * M_PI},
      {"A/(t_position - 400)", 400.0, 400.0},
      {"A*(1 + sqrt((t - 610)^2 - 1))", 609.0, 611.0},
      {"A*(2 + log(abs(t - 610) - 1))", 609.0, 611.0}};
  const Timeline timeline = six();
  for (const auto& [equation, first, last] : cases) {
    const auto gaps = gaps_of(equation, timeline);
    ASSERT_EQ(gaps.size(), 1u) << equation;
    // 2^-20 of the 30 s from node to node.
    EXPECT_GE(gaps[0].t, first - 3e-5) << equation;
    EXPECT_LE(gaps[0].t, last + 3e-5) << equation;
    EXPECT_EQ(gaps[0].position, first < 1200.0 ? 0 : 1) << equation;
    EXPECT_FALSE(gaps[0].slew) << equation;
  }
}

/// On the way from level to upright an axis passes every specific force in between.
TEST(OwnTermGaps, APoleInWhatThePlatformSeesIsFoundOnTheWay) {
  const auto gaps =
      gaps_of("A/(f_x - 0.3)", preset_timeline("slew12", CommandLaw::level, 600.0, 60.0));
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_TRUE(gaps[0].slew);
}

TEST(OwnTermGaps, JumpsKinksAndNarrowPeaksAreNumbers) {
  const Timeline timeline = six();
  for (const char* equation :
       {"A*tanh((t - 610)/1e-3)", "A/(0.01 + abs(t - 610))", "A/(step(t - 610) - 0.5)",
        "A*(t - 610)/(sign(t - 610) + 0.5)", "A*sqrt(max(t - 610, 0))",
        "A*(max(t - 610, 0)/60)^0.7", "A/(t*t - 1220*t + 372101)", "A/((t - 610)^2 + 1)",
        "A*log(1 + t/60)", "A*sin(1e3*t)/(1.5 + sin(t/100))", "A*max(t, 0)^-0",
        "A*(1 + f_x)^3*exp(-t/60)"})
    EXPECT_TRUE(gaps_of(equation, timeline).empty()) << equation;
}

TEST(OwnTermGaps, TermsOfEveryKindHaveNone) {
  const OwnTermsHeld held(own_terms_of_every_kind());
  for (const std::string_view preset : {"slew12", "casespin"}) {
    Timeline timeline = preset_timeline(preset, CommandLaw::level, 600.0, 60.0);
    set_environment(timeline, harbin_day(), 1, 0);
    for (const OwnTermGap& gap : own_term_gaps(timeline, own_model()))
      ADD_FAILURE() << own_terms().terms[gap.own].key << " at " << gap.t;
  }
}

TEST(OwnTermGaps, ATermOfAColumnIsForRecordings) {
  EXPECT_TRUE(gaps_of("A*pressure/(t - 610)", six()).empty());
}

/// What a range says of a stretch holds every value within, and no more where nothing is named
/// twice.
TEST(Range, HoldsWhatAFunctionComesTo) {
  const auto expect = [](const Range& range, double lo, double hi) {
    EXPECT_TRUE(range.everywhere);
    EXPECT_NEAR(range.lo, lo, 1e-15);
    EXPECT_NEAR(range.hi, hi, 1e-15);
  };
  const Range x(-1.0, 2.0), positive(1.0, 4.0);
  expect(x * x, -2.0, 4.0);
  expect(whole_power(x, 2), 0.0, 4.0);
  expect(whole_power(x, 3), -1.0, 8.0);
  expect(whole_power(positive, -1), 0.25, 1.0);
  expect(abs(x), 0.0, 2.0);
  expect(x - positive, -5.0, 1.0);
  expect(x / positive, -1.0, 2.0);
  expect(sin(x), std::sin(-1.0), 1.0);
  expect(cos(Range(3.0, 4.0)), -1.0, std::cos(4.0));
  expect(sin(Range(100.0, 107.0)), -1.0, 1.0);
  expect(root_of(positive), 1.0, 2.0);
  expect(any_power(Range(0.0, 4.0), Range(0.5)), 0.0, 2.0);
  expect(step_at(x), 0.0, 1.0);
  expect(smaller_of(x, positive), -1.0, 2.0);
  expect(larger_of(x, positive), 1.0, 4.0);
  for (const Range& broken : {positive / x, log_of(x), root_of(x), any_power(x, Range(0.5)),
                              whole_power(x, -2), exp(Range(0.0, 1e3)), x + log_of(x)})
    EXPECT_FALSE(broken.everywhere);
}

}  // namespace
}  // namespace drift::own_term_gaps_test
