// Of two alternatives one may be the other and more: what is advised about such a pair.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/diagnosis/advice/advise.hpp"
#include "analysis/report/diagnosis/words/advice_words.hpp"
#include "core/sim/measurements.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::diagnosis::nested_advice_test {
namespace {

search::Cause cause(std::string_view key, int set) {
  search::Cause c;
  c.term = "g2_drift";
  c.set = set;
  c.parameters = {{std::string(key), test::param(key), 0.1, 0.01, "deg/h/g^2", false}};
  return c;
}

TEST(NestedAdvice, APairThatPositionsHelpOneWayRoundIsNotCalledInseparable) {
  mc::Study s;
  s.path = "study.toml";
  s.site = test::harbin;
  PlanDefaults defaults;
  defaults.mode = CommandLaw::level;
  defaults.dwell = 600.0;
  s.plan = preset_plan("six", defaults).value();
  s.truth = test::base_truth(Coupling::eq5);
  FilterSpec nominal = test::base_filter(Coupling::eq5);
  nominal.active &= ~test::only({"D_II", "D_SS", "D_OO", "D_IO", "D_IS", "D_OS"});
  s.truth.active = nominal.active;
  s.filters = {nominal};
  const Timeline timeline = lay_out(s.plan, s.site);
  const TruthDraw draw = draw_truth(s.truth, timeline.chains, 1, 0);
  const Recording recording = make_recording(
      timeline, Simulator(s.truth, s.readout).run(timeline, draw, 1, 0).measured, s.readout);

  Diagnosis d;
  d.nominal = nominal;
  d.verdict = Verdict::ambiguous;
  d.causes = {cause("D_IS_x", 0), cause("D_IS_x", 1), cause("D_IO_y", 1)};
  const std::vector<Advice> advice = advise(s, {recording}, d);
  std::vector<planning::Contest> pairs;
  for (const Advice& a : advice)
    for (const AdvisedPair& p : a.pairs) pairs.push_back(p.pair);
  ASSERT_EQ(advice.size(), 1u) << report::advice_in_brief(advice);
  EXPECT_EQ(advice.front().kind, Advice::Kind::add);
  EXPECT_EQ(pairs, (std::vector<planning::Contest>{{1, 0}})) << "where both act";
  const std::string said = report::advice_in_brief(advice);
  EXPECT_EQ(said.find("no position separates"), said.npos) << said;
}

}  // namespace
}  // namespace drift::diagnosis::nested_advice_test
