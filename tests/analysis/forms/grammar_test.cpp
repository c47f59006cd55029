#include "analysis/forms/grammar.hpp"

#include <gtest/gtest.h>

#include <set>

#include "analysis/forms/bins.hpp"
#include "analysis/forms/term_text.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::forms::grammar_test {
namespace {

using namespace drift::test;

struct Ground {
  Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1200.0, 120.0);
  Instants at = instants_of(timeline);
  Bins bins = bins_of(timeline);
  Grammar grammar = grammar_of(at, bins.start, bins.length, true, true);
};

TEST(Grammar, PriorsOfAllFormsSumToOneAtMost) {
  const Ground g;
  double sum = 0.0;
  for (const AttitudePart& w : g.grammar.where)
    for (const TimePart& t : g.grammar.when) sum += std::exp(g.grammar.log_prior(w.kind, t.kind));
  sum += static_cast<double>(g.grammar.windows) *
         std::exp(g.grammar.log_prior(AttitudePart::Kind::one, TimePart::Kind::window));
  sum *= static_cast<double>(g.grammar.places.size());
  EXPECT_LE(sum, 1.0 + 1e-12);
  EXPECT_GT(sum, 0.5);  // windows of attitude parts, which are not tried, are all that is missing
}

TEST(Grammar, EveryKindOfFormOnEveryPlaceIsATermThatAStudyTakes) {
  const Ground g;
  std::set<std::pair<AttitudePart::Kind, TimePart::Kind>> had;
  for (const AttitudePart& w : g.grammar.where)
    for (const TimePart& t : g.grammar.when) {
      if ((is_pair(w) && is_pair(t)) || !had.insert({w.kind, t.kind}).second) continue;
      for (const OwnTarget& place : g.grammar.places) {
        Form form{place, w, t, 0.0};
        if (double* sigma = sigma_of_moved(form)) *sigma = 0.1 * *moved_setting(form);
        const std::string text = term_text(form, g.at, "form_1", 3e-8);
        ASSERT_NO_THROW(const OwnTermsHeld held(text)) << text;
      }
    }
  EXPECT_EQ(had.size(), 7u * 6u - 1u);  // all kinds but the pair of pairs
}

TEST(Grammar, EveryProductOfQuantitiesIsATermThatAStudyTakes) {
  const Ground g;
  for (const AttitudePart& w : g.grammar.where) {
    if (w.kind != AttitudePart::Kind::product) continue;
    const std::string text =
        term_text({g.grammar.places.front(), w, {}, 0.0}, g.at, "form_1", 3e-8);
    ASSERT_NO_THROW(const OwnTermsHeld held(text)) << text;
  }
}

TEST(Grammar, ThresholdsPartThePositionsAndPeriodsStayInPhaseOverTheTest) {
  const Ground g;
  for (const AttitudePart& w : g.grammar.where) {
    if (w.kind != AttitudePart::Kind::above) continue;
    const VecX on = columns_of(w, g.at);
    EXPECT_GT(on.sum(), 0.0);
    EXPECT_LT(on.sum(), static_cast<double>(on.size()));
  }
  const double length = g.at.t.maxCoeff() - g.at.t.minCoeff();
  double before = 0.0;
  for (const TimePart& t : g.grammar.when) {
    if (t.kind != TimePart::Kind::harmonic) continue;
    if (before > 0.0) {
      EXPECT_NEAR(length / t.setting - length / before, 0.5, 1e-9);
    }
    before = t.setting;
  }
  EXPECT_NEAR(before, 4.0 * g.bins.length, 4.0 * g.bins.length * 0.1);
}

}  // namespace
}  // namespace drift::forms::grammar_test
