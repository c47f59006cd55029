// Headline, where, windows and recovered signal agree, whatever the cause.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/acting.hpp"
#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/diagnosis/located.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::diagnosis::where_follows_test {
namespace {

using namespace drift::test;

/// What the equations that a term adds to are called.
std::string kind_of(const TermInfo& term) {
  if (term.in_readout) return "accelerometer ";
  if (term.in_rates) return "platform rate ";
  return term.in_offset ? "attitude offset " : "gimbal ";
}

const TermInfo& info_of(const search::Cause& cause) {
  return TermLibrary::terms[*TermLibrary::find_term(cause.term)];
}

/// The last amplitude of a term four of its prior sigmas large, and a nominal filter without it.
Diagnosis diagnosed(std::size_t term) {
  const Timeline timeline = scene("slew12", CommandLaw::level, 1200.0, 120.0);
  const ParamMask own = term_params(term);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active |= own;
  TruthDraw draw = draw_truth(truth, timeline.chains, 3, 1);
  FilterSpec nominal = base_filter(Coupling::eq5);
  nominal.active &= ~(own | only({"D_II", "D_OO", "D_SS", "D_IO", "D_IS", "D_OS", "s"}));
  std::size_t hidden = TermLibrary::num_params;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) {
    if (nominal.active[i]) continue;
    const Prior prior = TermLibrary::specs.size() > i ? TermLibrary::specs[i].prior_si() : Prior{};
    draw.theta[i] = own[i] ? prior.mean() : 0.0;
    if (own[i] && TermLibrary::specs[i].amplitude()) hidden = i;
  }
  if (hidden < TermLibrary::num_params)
    draw.theta[hidden] += 4.0 * TermLibrary::specs[hidden].prior_si().sigma();
  if (TermLibrary::terms[term].key == "mass_unbalance_step") draw.theta[param("dD_t0")] = 7200.0;
  const Readout readout;
  const Simulation sim = Simulator(truth, readout).run(timeline, draw, 3, 1);
  DiagnoseOptions options;
  options.folds = FoldMethod::linear;
  options.signals = Signals::recovered;
  options.profiles = Profiles::left_out;
  options.proposing = Proposing::left_out;
  options.whiteness_draws = 0;
  return diagnose(nominal, {timeline, readout, sim.measured}, {}, {}, options);
}

/// Of a cause that is named everything follows from it.
void expect_from_the_cause(const Diagnosis& d) {
  const std::string headline = report::sentence(d), where = report::where_sentence(d.where);
  EXPECT_EQ(where.find("strongest window"), std::string::npos) << where;
  std::size_t onsets = 0;
  for (const search::Cause& cause : d.causes) {
    const std::string kind = kind_of(info_of(cause));
    EXPECT_NE(headline.find(report::in_words(cause.term, cause.axis)), std::string::npos)
        << headline;
    EXPECT_TRUE(std::ranges::any_of(d.where.equations,
                                    [&](const std::string& e) {
                                      return e.starts_with(kind) &&
                                             (cause.axis.size() != 1 || e.ends_with(cause.axis));
                                    }))
        << headline << "\n"
        << where;
    onsets += acting_of(cause)->onset ? 1 : 0;
  }
  EXPECT_EQ(d.where.windows.size(), onsets) << headline;
  ASSERT_EQ(d.signals.size(), d.where.equations.size()) << headline;
  for (std::size_t k = 0; k < d.signals.size(); ++k) {
    EXPECT_EQ(d.signals[k].equation, d.where.equations[k]);
    EXPECT_EQ(d.signals[k].shape.kind, Shape::Kind::of_cause);
    EXPECT_NE(where.find(report::equation_in_words(d.where.equations[k])), std::string::npos)
        << where;
  }
}

/// For each of some terms; at least so many of them must be named.
void expect_agreement(const std::vector<std::size_t>& terms, std::size_t at_least) {
  std::size_t named = 0, stepped = 0;
  for (const std::size_t term : terms) {
    SCOPED_TRACE(TermLibrary::terms[term].key);
    const Diagnosis d = diagnosed(term);
    if (d.verdict == Verdict::consistent) continue;
    ASSERT_FALSE(d.signals.empty());
    EXPECT_EQ(d.signals.front().equation, d.where.equation);
    EXPECT_NE(report::where_sentence(d.where).find(report::equation_in_words(d.where.equation)),
              std::string::npos);
    if (d.verdict != Verdict::named) {  // no other shape than the headline's
      for (std::size_t k = 0; k < d.signals.size(); ++k)
        EXPECT_TRUE(d.verdict == Verdict::ambiguous
                        ? d.signals[k].shape.kind == Shape::Kind::of_alternative
                        : k == 0 || report::shape_text(d.signals[k]).empty())
            << report::sentence(d);
      continue;
    }
    ++named;
    expect_from_the_cause(d);
    if (d.causes.front().term == "mass_unbalance_step") {
      ++stepped;
      EXPECT_NEAR(d.where.onset_s, 7200.0, 600.0);
      EXPECT_NE(report::where_sentence(d.where).find("it sets in at"), std::string::npos);
    }
  }
  EXPECT_GE(named, at_least);
  EXPECT_EQ(stepped, 1u);
}

TEST(WhereFollows, HeadlineBulletsAndRecoveredSignalAgreeForEveryThirdCause) {
  const auto all = visible_terms();
  const auto is_step = [](std::size_t t) {
    return TermLibrary::terms[t].key == "mass_unbalance_step";
  };
  const auto step = static_cast<std::size_t>(std::ranges::find_if(all, is_step) - all.begin());
  ASSERT_LT(step, all.size());
  std::vector<std::size_t> some;
  for (std::size_t k = step % 3; k < all.size(); k += 3) some.push_back(all[k]);
  expect_agreement(some, 5);
}

TEST(WhereFollowsNightly, HeadlineBulletsAndRecoveredSignalAgreeForEveryCause) {
  expect_agreement(visible_terms(), 15);
}

TEST(WhereFollows, AFormThatFitsSaysWhereAndTheOtherSignalsKeepTheirOrder) {
  Located place;
  for (const char* equation : {"platform rate y", "gimbal inner", "accelerometer z"})
    place.signals.emplace_back().equation = equation;
  place.where.equation = "platform rate y";
  const auto order_after = [&](const char* acts_on) {
    Proposal form;
    form.acts_on = acts_on;
    move_to(place, form);
    std::string order = place.where.equation;
    for (const RecoveredSignal& s : place.signals) order += ", " + s.equation;
    return order;
  };
  EXPECT_EQ(order_after("accelerometer.z"),
            "accelerometer z, accelerometer z, platform rate y, gimbal inner");
  EXPECT_EQ(order_after("drift.y"),
            "platform rate y, platform rate y, accelerometer z, gimbal inner");
  EXPECT_EQ(place.signals.front().shape.kind, Shape::Kind::of_form);
  EXPECT_EQ(report::shape_text(place.signals.back()), "");
  EXPECT_EQ(order_after("gimbal.outer"),
            "gimbal outer, platform rate y, accelerometer z, gimbal inner");
}

}  // namespace
}  // namespace drift::diagnosis::where_follows_test
