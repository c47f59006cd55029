// What the search for causes makes of effects that are easily taken for something else.
#include "analysis/search/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/causes.hpp"
#include "analysis/search/pairs.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::search::search_test {
namespace {

using namespace drift::test;

struct Bench {
  Timeline timeline;
  Readout readout;
  FilterSpec filter = base_filter(Coupling::eq5);
  Measurements measured;

  Bench(std::string_view preset, double dwell)
      : timeline(preset_timeline(preset, CommandLaw::free, dwell, 60.0)) {}
  Fitted nominal() const {
    const MeasuredTest test{timeline, readout, measured};
    return examine(filter, test,
                   fit_batch(filter, {timeline, readout, measured}, make_layout(filter).theta));
  }
  Search found() const { return search(nominal(), {timeline, readout, measured}, {}); }
};

TEST(Search, AnErrorThatNoCandidateHoldsIsLeftUnexplained) {
  Bench b("six", 1800.0);
  b.measured = Simulator(base_truth(Coupling::eq5), b.readout).run(b.timeline, 12, 0).measured;
  for (std::size_t i = 0; i < b.timeline.intervals.size(); ++i) {
    // A resolver error that builds up in 25 min and falls back: 1.7 sigma rms in 180 samples, 23
    // sigma.
    const double turn = b.timeline.intervals[i].t1 / 1500.0;
    b.measured.gimbal(1, static_cast<Eigen::Index>(i)) +=
        30.0 * detail::deg / 3600.0 * (turn - std::floor(turn) - 0.5);
  }
  const Search s = b.found();
  EXPECT_TRUE(s.significant);
  EXPECT_TRUE(s.sets.empty());
  EXPECT_EQ(s.nominal.unknown->lone.equation, "gimbal middle");
}

TEST(Search, ARampOfOneGyroIsNamedAndNotTakenForNoise) {
  Bench b("twelve", 1800.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active.set(param("ramp_z"));
  TruthDraw draw = draw_truth(truth, b.timeline.chains, 12, 1);
  draw.theta[param("ramp_z")] = 6e-3 * TermLibrary::specs[param("ramp_z")].unit.to_si;
  b.measured = Simulator(truth, b.readout).run(b.timeline, draw, 12, 1).measured;
  const Search s = b.found();
  ASSERT_TRUE(s.significant);
  ASSERT_FALSE(s.sets.empty());
  EXPECT_FALSE(s.sets.front().after.noise.driven);
  ASSERT_EQ(s.sets.front().choices.size(), 1u);
  const inference::Candidate& c = s.nominal.set.candidates[s.sets.front().choices[0].candidate];
  EXPECT_EQ(c.label, "drift_ramp.z");
  const ParameterEstimate* p = s.sets.front().after.fit.estimate.find(param("ramp_z"));
  ASSERT_NE(p, nullptr);
  EXPECT_NEAR(p->value, draw.theta[param("ramp_z")], 4.0 * p->sigma);
}

/// A step of the mass unbalance of gyro y at 2.6 h, where the grid has 2 and 3 h.
struct StepBetweenHours {
  Bench b{"twelve", 1800.0};
  TruthDraw draw;

  explicit StepBetweenHours(std::uint64_t run) {
    TruthSpec truth = base_truth(Coupling::eq5);
    truth.active.set(param("dD_I_y")).set(param("dD_t0"));
    draw = draw_truth(truth, b.timeline.chains, 12, run);
    draw.theta[param("dD_I_y")] = 0.03 * TermLibrary::specs[param("dD_I_y")].unit.to_si;
    draw.theta[param("dD_t0")] = 2.6 * 3600.0;
    b.measured = Simulator(truth, b.readout).run(b.timeline, draw, 12, run).measured;
  }
};

TEST(Search, AStepBetweenTheHoursOfTheGridIsNamedAloneWithItsTime) {
  const StepBetweenHours step(7);
  const TruthDraw& draw = step.draw;
  const Search s = step.b.found();
  ASSERT_TRUE(s.significant);
  ASSERT_EQ(s.sets.size(), 1u);
  ASSERT_EQ(s.sets.front().choices.size(), 1u);
  const Choice choice = s.sets.front().choices.front();
  const inference::Candidate& c = s.nominal.set.candidates[choice.candidate];
  EXPECT_EQ(c.label, "mass_unbalance_step.y");
  EXPECT_TRUE(c.variants[choice.variant].between);
  // The axis bears no gravity from 2 to 4 h: the sigma of the time must say that it may be any in
  // between.
  const auto causes = diagnosis::causes_of(s.nominal, s).causes;
  ASSERT_EQ(causes.size(), 1u);
  for (const char* key : {"dD_I_y", "dD_t0"}) {
    const auto p = std::ranges::find(causes[0].parameters, key, &CauseParameter::key);
    ASSERT_NE(p, causes[0].parameters.end());
    EXPECT_NEAR(p->value, draw.theta[param(key)] / TermLibrary::specs[param(key)].unit.to_si,
                4.0 * p->sigma)
        << key;
  }
  // Settings between the points share the chances of the points: as many as there are on the grid.
  double share = 0.0, points = 0.0;
  for (const inference::Variant& v : c.variants) {
    share += v.share;
    points += v.between ? 0.0 : 1.0;
  }
  EXPECT_NEAR(share, points, 1e-12);
}

TEST(Search, ASecondCauseThatIsThereByChanceStandsBesideTheFirstAndNotBeforeIt) {
  // Of 24 such recordings one has an azimuth error of 4 sigma by chance (7e-5 of each of some 200
  // candidates): two causes are nearly as probable as the one that is there.
  const Search s = StepBetweenHours(2).b.found();
  ASSERT_EQ(s.sets.size(), 2u);
  for (const Refit& r : s.sets) {
    const Choice& first = r.choices.front();
    EXPECT_EQ(s.nominal.set.candidates[first.candidate].label, "mass_unbalance_step.y");
  }
  EXPECT_EQ(s.sets[0].choices.size(), 1u);
  EXPECT_EQ(s.sets[1].choices.size(), 2u);
  EXPECT_GT(s.probability[0], 0.5);
}

TEST(Search, TwoPartsOfATermThatShareAParameterAreNoPair) {
  // The quadratic parts of all axes and all parts of one axis share one parameter: no fit tells
  // them apart, and their evidence was no number.
  Bench b("twentyfour", 1800.0);
  TruthSpec truth = base_truth(Coupling::eq5);
  for (const std::string_view kind : {"K_io", "K_po", "K_pp", "K_oo"}) truth.active |= only({kind});
  b.measured = Simulator(truth, b.readout).run(b.timeline, 11, 0).measured;
  const Fitted nominal = b.nominal();
  const std::vector<Pair> pairs = adequate_pairs(nominal, nominal.scores, HUGE_VAL, HUGE_VAL, 1000);
  ASSERT_GT(pairs.size(), 10u);
  for (const Pair& p : pairs) {
    const inference::Candidate &one = nominal.set.candidates[p.a.candidate],
                               &other = nominal.set.candidates[p.b.candidate];
    EXPECT_FALSE(one.overlaps(other)) << one.label << " and " << other.label;
    EXPECT_TRUE(std::isfinite(p.log_bayes)) << one.label << " and " << other.label;
  }
}

}  // namespace
}  // namespace drift::search::search_test
