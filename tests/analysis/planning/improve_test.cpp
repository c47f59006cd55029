#include "analysis/planning/improve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/observability/ranking.hpp"
#include "analysis/planning/position_pool.hpp"
#include "core/base/check.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::improve_test {
namespace {

using namespace drift::test;

TestPlan preset_plan(std::string_view preset, CommandLaw mode) {
  PlanDefaults defaults;
  defaults.mode = mode;
  defaults.dwell = 600.0;
  defaults.sample = 120.0;
  return preset_plan(preset, defaults).value();
}

observability::RankedModel model_of(Coupling coupling, std::initializer_list<const char*> keys) {
  ModelSpec spec = base_spec(coupling);
  spec.active.reset();
  for (const char* key : keys) spec.active |= only({key});
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

/// Adds two positions to a plan, each of which brings what it promised: the plan with it, ranked
/// anew.
planning::Improvement two_kept_promises(TestPlan& plan, const observability::RankedModel& model,
                                        const char* criterion) {
  planning::Improvement better = planning::improve_plan(
      plan, model, planning::parse_criterion(criterion, make_layout(model.spec)), 2, 2);
  EXPECT_EQ(better.steps.size(), 2u);
  EXPECT_LT((better.before - learning_ratios(plan, model)).norm(), 1e-9);
  for (const planning::ImprovementStep& s : better.steps) {
    plan.positions.push_back(s.position);
    const VecX now = learning_ratios(plan, model);
    EXPECT_LT((s.learning_ratios.cwiseQuotient(now).array() - 1.0).abs().maxCoeff(), 1e-9);
  }
  return better;
}

TEST(Improve, EveryPromiseHoldsWhenThePlanIsRankedAnew) {
  // A ramp knows the time, the heat of torquers remembers the slews before.
  const auto base = {"D_F", "D_I", "D_S", "eta", "xi", "s", "K0"}, clock = {"D_F", "D_I", "ramp"},
             memory = {"D_F", "D_I", "heat", "heat_tau"};
  struct Case {
    const char *preset, *criterion;
    std::initializer_list<const char*> keys;
  };
  for (const Case& c : {Case{"six", "A", base},
                        {"six", "eta_y", base},
                        {"slew12", "D", base},
                        {"six", "A", clock},
                        {"slew12", "A", memory}}) {
    const observability::RankedModel model = model_of(Coupling::eq5, c.keys);
    TestPlan plan = preset_plan(c.preset, CommandLaw::free);
    plan.positions.resize(3);
    const double duration = observability::linearise(plan, model).duration;
    SCOPED_TRACE(c.preset);
    const planning::Improvement better = two_kept_promises(plan, model, c.criterion);
    for (const planning::ImprovementStep& s : better.steps) {
      EXPECT_LT(s.after, s.before);
      EXPECT_GT(s.feasible, 90u);
    }
    EXPECT_EQ(better.plan.positions.size(), 5u);
    EXPECT_NEAR(better.added(), observability::linearise(plan, model).duration - duration, 1e-6);
  }
}

TEST(Improve, EveryPromiseHoldsWhereSomethingRandomDrivesThePlatform) {
  constexpr double per_sqrt_h = 1.0 / 60.0;  // [1/sqrt(s)]
  const ProcessNoise angle{.angle_random_walk = 1e-3 * detail::deg * per_sqrt_h},
      drift{.drift_random_walk = 0.02 * deg_per_h * per_sqrt_h};
  struct Case {
    const char* criterion;
    ProcessNoise noise;
  };
  for (const Case& c : {Case{"A", angle}, {"A", drift}, {"D_F_z", drift}}) {
    observability::RankedModel model = model_of(Coupling::eq5, {"D_F", "D_I", "eta"});
    model.spec.noise = c.noise;
    TestPlan plan = preset_plan("slew12", CommandLaw::free);
    plan.positions.resize(2);
    SCOPED_TRACE(c.criterion);
    const planning::Improvement better = two_kept_promises(plan, model, c.criterion);
    for (const planning::ImprovementStep& s : better.steps) {
      // A drift that walks is soon known as well as it ever will be.
      if (c.criterion == std::string("A")) {
        EXPECT_LT(s.after, s.before);
      }
    }
  }
}

TEST(Improve, TheChoiceIsTheBestOfAllCandidatesRankedInFull) {
  const observability::RankedModel model = model_of(Coupling::eq6, {"D_F", "eta"});
  TestPlan plan = preset_plan("slew12", CommandLaw::level);
  plan.positions.resize(2);
  const planning::Criterion criterion = planning::parse_criterion("eta_x", make_layout(model.spec));
  const planning::Improvement better = planning::improve_plan(plan, model, criterion, 1, 2);
  const Timeline timeline = lay_out(plan, harbin);
  const Position& last = plan.positions.back();
  const double left = std::round(timeline.intervals.back().heading1 / detail::deg);
  std::vector<std::optional<double>> headings{std::nullopt};
  for (const double turn : {-360.0, -180.0, 180.0, 360.0})
    headings.emplace_back((left + turn) * detail::deg);
  std::vector<planning::Addition> candidates = planning::held(
      planning::all_attitudes(), {Entry::torqued, last.dwell, last.sample, headings});
  for (const planning::Addition& a :
       planning::held(planning::all_attitudes(), {Entry::caged, last.dwell, last.sample}))
    candidates.push_back(a);
  double best = 1.0;
  std::size_t feasible = 0;
  for (const planning::Addition& a : candidates) {
    TestPlan longer = plan;
    longer.positions.push_back(a.front());
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
  TestPlan plan = preset_plan("slew12", CommandLaw::free);
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
}

TEST(Improve, AnUnknownCriterionNamesWhatItBeginsOrAll) {
  const Layout layout = make_layout(base_spec(Coupling::eq5));
  const auto said_of = [&](const char* text) {
    try {
      planning::parse_criterion(text, layout);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(said_of("eta").find("Use one of eta_x, eta_y, eta_z"), std::string::npos)
      << said_of("eta");
  // Another letter in the place of a whole name is no slip of it.
  const std::string all = said_of("T_x");
  EXPECT_EQ(all.find("Did you mean"), std::string::npos) << all;
  EXPECT_NE(all.find("Use A, D or one of "), std::string::npos) << all;
  for (const char* key : {" s_x", "eta_x", "D_F_x", "K0_x"})
    EXPECT_NE(all.find(key), std::string::npos) << key << ": " << all;
  EXPECT_EQ(all.find("D_F_y"), std::string::npos) << "of a triad the first: " << all;
  EXPECT_NE(said_of("S_x").find("Did you mean 's_x'?"), std::string::npos) << said_of("S_x");
}

TEST(Improve, ACriterionThatIsNoStateIsSaidToBeKnown) {
  ModelSpec spec = base_spec(Coupling::eq5);  // which has no lambda
  spec.priors[param("eta_x")] = fixed(100.0 * arcsec);
  for (const char* key : {"eta_x", "lambda"}) {
    try {
      planning::parse_criterion(key, make_layout(spec));
      FAIL() << key;
    } catch (const InputError& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
      const std::string said = e.what();
      EXPECT_NE(said.find("the filter does not estimate it"), std::string::npos) << said;
      EXPECT_EQ(said.find("unknown"), std::string::npos) << said;
      EXPECT_EQ(said.find("Did you mean"), std::string::npos) << said;
    }
  }
}

}  // namespace
}  // namespace drift::improve_test
