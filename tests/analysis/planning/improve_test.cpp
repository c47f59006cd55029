#include "analysis/planning/improve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/observability/ranking.hpp"
#include "analysis/planning/candidates.hpp"
#include "core/base/check.hpp"
#include "tests/support/model_builders.hpp"

namespace drift {
namespace {

using namespace drift::test;

TestPlan plan_of(std::string_view preset, CommandLaw mode) {
  PlanDefaults defaults;
  defaults.mode = mode;
  defaults.dwell = 600.0;
  defaults.sample = 120.0;
  return preset_plan(preset, defaults).value();
}

observability::RankedModel model_of(Coupling coupling,
                                    std::initializer_list<std::string_view> keys) {
  ModelSpec spec = base_spec(coupling);
  spec.active = only(keys);
  observability::RankedModel model = observability::ranked_model(spec, nullptr, harbin, Readout{});
  model.nominal[param("D_I_z")] = 1.45 * deg_per_h;  // so that eq. (6) has levers in free drift
  return model;
}

VecX learning_ratios(const TestPlan& plan, const observability::RankedModel& model) {
  const observability::Ranking r =
      observability::rank_parameters(observability::linearise(plan, model));
  VecX all(static_cast<Eigen::Index>(r.parameters.size()));
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    all[static_cast<Eigen::Index>(k)] = r.learning_ratio(k);
  return all;
}

TEST(Improve, CandidatesAre96FramesAsTheirTextSays) {
  const auto all = planning::candidate_axes();
  EXPECT_EQ(all.size(), 96u);
  std::vector<Mat3> frames;
  for (const std::string& axes : all) {
    std::string why;
    const auto R_lp = parse_axes(axes, why);
    ASSERT_TRUE(R_lp) << axes << ": " << why;
    for (const Mat3& other : frames) EXPECT_GT((*R_lp - other).norm(), 0.1) << axes;
    frames.push_back(*R_lp);
  }
  const TestPlan caged = plan_of("six", CommandLaw::level),
                 torqued = plan_of("slew12", CommandLaw::level);
  EXPECT_EQ(planning::caged_candidates(caged).size(), 2u * 96u);
  EXPECT_TRUE(planning::torqued_candidates(caged, 0.0).empty());
  EXPECT_EQ(planning::torqued_candidates(torqued, 0.0).size(), 4u * 96u);
}

TEST(Improve, LowRankUpdateIsTheRecomputation) {
  // Rows from nearly nothing to very much information, on parameters and on the chain's attitude.
  for (const double size : {1e-4, 1.0, 1e5}) {
    Stream stream(3, 0, Purpose::test);
    const auto random = [&](Eigen::Index r, Eigen::Index c, double scale) {
      MatX m(r, c);
      for (double& v : m.reshaped()) v = scale * stream.normal();
      return m;
    };
    observability::InformationSum sum(10);
    sum.add(0, random(20, 13, 1.0));
    sum.add(1, random(4, 13, 100.0));
    const MatX rows = random(7, 13, size), J = planning::compressed(rows);
    const planning::UpdatedBelief updated =
        planning::updated_belief(planning::joint_posterior(sum), J);
    sum.add(1, rows);
    const observability::Posterior again = observability::posterior_of(sum.root());
    EXPECT_LT((updated.sigma.cwiseQuotient(again.sigma).array() - 1.0).abs().maxCoeff(), 1e-9)
        << size;
    EXPECT_NEAR(updated.half_log2_det, -again.bits, 1e-9 * again.bits) << size;
  }
}

TEST(Improve, FewRowsStandForMany) {
  Stream stream(4, 0, Purpose::test);
  MatX factor(40, 5), mix(5, 13);
  for (double& v : factor.reshaped()) v = stream.normal();
  for (double& v : mix.reshaped()) v = stream.normal();
  const MatX rows = factor * mix, few = planning::compressed(rows);
  EXPECT_EQ(few.rows(), 5);
  EXPECT_LT((rows.transpose() * rows - few.transpose() * few).norm(), 1e-11 * rows.squaredNorm());
  EXPECT_EQ(planning::compressed(MatX::Zero(4, 13)).rows(), 0);
}

TEST(Improve, EveryPromiseHoldsWhenThePlanIsRankedAnew) {
  struct Case {
    const char *preset, *criterion;
  };
  for (const Case& c : {Case{"six", "A"}, {"six", "eta_y"}, {"slew12", "D"}}) {
    const observability::RankedModel model =
        model_of(Coupling::eq5, {"D_F", "D_I", "D_S", "eta", "xi", "s", "K0"});
    TestPlan plan = plan_of(c.preset, CommandLaw::free);
    plan.positions.resize(3);
    const double duration = observability::linearise(plan, model).duration;
    const planning::Criterion criterion =
        planning::parse_criterion(c.criterion, make_layout(model.spec));
    const planning::Improvement better = planning::improve_plan(plan, model, criterion, 2, 2);
    ASSERT_EQ(better.steps.size(), 2u);
    EXPECT_LT((better.before - learning_ratios(plan, model)).norm(), 1e-9);
    for (const planning::ImprovementStep& s : better.steps) {
      plan.positions.push_back(s.position);
      const VecX now = learning_ratios(plan, model);
      EXPECT_LT((s.learning_ratios.cwiseQuotient(now).array() - 1.0).abs().maxCoeff(), 1e-9)
          << c.preset;
      EXPECT_LT(s.after, s.before);
      EXPECT_GT(s.feasible, 90u);
    }
    EXPECT_EQ(better.plan.positions.size(), 5u);
    EXPECT_NEAR(better.added(), observability::linearise(plan, model).duration - duration, 1e-6);
  }
}

TEST(Improve, TheChoiceIsTheBestOfAllCandidatesRankedInFull) {
  const observability::RankedModel model = model_of(Coupling::eq6, {"D_F", "eta"});
  TestPlan plan = plan_of("slew12", CommandLaw::level);
  plan.positions.resize(2);
  const planning::Criterion criterion = planning::parse_criterion("eta_x", make_layout(model.spec));
  const planning::Improvement better = planning::improve_plan(plan, model, criterion, 1, 2);
  const Timeline timeline = lay_out(plan, harbin);
  std::vector<Position> candidates = planning::caged_candidates(plan);
  for (const Position& p : planning::torqued_candidates(plan, timeline.intervals.back().heading1))
    candidates.push_back(p);
  double best = 1.0;
  std::size_t feasible = 0;
  for (const Position& p : candidates) {
    TestPlan longer = plan;
    longer.positions.push_back(p);
    try {
      best = std::min(best,
                      learning_ratios(longer, model)[static_cast<Eigen::Index>(criterion.state)]);
      ++feasible;
    } catch (const InputError&) {  // beyond the gimbals
    }
  }
  EXPECT_EQ(better.steps.front().feasible, feasible);
  EXPECT_NEAR(better.steps.front().after / best, 1.0, 1e-9);
}

TEST(Improve, DoesNotDependOnThreads) {
  const observability::RankedModel model = model_of(Coupling::eq5, {"D_F", "D_I", "eta"});
  TestPlan plan = plan_of("slew12", CommandLaw::free);
  plan.positions.resize(2);
  const planning::Criterion criterion = planning::parse_criterion("A", make_layout(model.spec));
  const planning::Improvement one = planning::improve_plan(plan, model, criterion, 1, 1),
                              three = planning::improve_plan(plan, model, criterion, 1, 3);
  EXPECT_EQ(one.steps.front().position.axes, three.steps.front().position.axes);
  EXPECT_EQ(one.steps.front().learning_ratios, three.steps.front().learning_ratios);
}

TEST(Improve, AnUnknownCriterionNamesTheNearest) {
  const Layout layout = make_layout(base_spec(Coupling::eq5));
  EXPECT_EQ(planning::parse_criterion("D_I_z", layout).kind, planning::Criterion::Kind::parameter);
  try {
    planning::parse_criterion("eta_w", layout);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_NE(std::string(e.what()).find("eta_"), std::string::npos) << e.what();
  }
  EXPECT_THROW(planning::parse_criterion("lambda", layout),
               InputError);  // known, but no state here
}

}  // namespace
}  // namespace drift
