// Sigmas of a plan under process noise: in closed form, and by the covariance of the EKF, which is
// another program (core/estimate/sequential/covariance.hpp).
#include <gtest/gtest.h>

#include "analysis/observability/drivers.hpp"
#include "analysis/observability/information_by_position.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "core/sim/predict.hpp"
#include "tests/analysis/observability/ranking_fixture.hpp"

namespace drift::process_noise_test {
namespace {

using namespace observability;

constexpr double per_sqrt_h = 1.0 / 60.0;  // [1/sqrt(s)]

RankedModel with_noise(RankedModel model, const ProcessNoise& noise) {
  model.spec.noise = noise;
  return model;
}

/// Some of everything, where the test shows it.
RankedModel some_model() {
  return model_of(Coupling::eq6, {"D_F", "D_I", "eta", "K0"});
}

const ProcessNoise& walks() {
  static const ProcessNoise noise{.angle_random_walk = 3e-4 * detail::deg * per_sqrt_h,
                                  .drift_random_walk = 0.01 * deg_per_h * per_sqrt_h};
  return noise;
}

/// Slews, cagings and turns of the case, of 24 samples or so.
TestPlan some_plan() {
  TestPlan plan = plan_of("slew12", CommandLaw::free, 1200.0, 300.0);
  plan.positions.resize(5);
  plan.positions[3].entry = Entry::caged;
  return plan;
}

/// What the EKF ends with after a test without noise. unread: a position that is not measured.
EstimateResult ekf_after(const TestPlan& plan, const RankedModel& model, int unread = -1) {
  const Timeline timeline = lay_out(plan, model.site);
  Measurements measured = predict(
      timeline, model.spec.model(), model.nominal,
      std::vector<Vec3>(static_cast<std::size_t>(timeline.chains), Vec3::Zero()), model.readout);
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i)
    if (timeline.intervals[i].position == unread)
      for (Mat3X* channel : {&measured.acc, &measured.gimbal})
        channel->col(static_cast<Eigen::Index>(i)).setConstant(std::nan(""));
  FilterSpec filter;
  static_cast<ModelSpec&>(filter) = model.spec;
  return run_ekf(filter, {timeline, model.readout, measured}, model.nominal);
}

VecX ratios_of(const EstimateResult& e) {
  VecX all(static_cast<Eigen::Index>(e.parameters.size()));
  for (std::size_t k = 0; k < e.parameters.size(); ++k)
    all[static_cast<Eigen::Index>(k)] = e.parameters[k].learning_ratio();
  return all;
}

VecX ratios_of(const Ranking& r) {
  VecX all(static_cast<Eigen::Index>(r.parameters.size()));
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    all[static_cast<Eigen::Index>(k)] = r.learning_ratio(k);
  return all;
}

double farthest(const VecX& a, const VecX& b) {
  return (a.cwiseQuotient(b).array() - 1.0).abs().maxCoeff();
}

TEST(ProcessNoise, SigmasAreThoseThatTheFilterReports) {
  struct Case {
    const char* name;
    ProcessNoise noise;
    std::string_view term;
  };
  for (const Case& c : {Case{"angle", {.angle_random_walk = walks().angle_random_walk}, ""},
                        {"drift", {.drift_random_walk = walks().drift_random_walk}, ""},
                        {"both", walks(), ""},
                        {"term", {}, "drift_random_walk"},
                        {"levels", {}, "bistable_drift"}}) {
    RankedModel m = some_model();
    if (!c.term.empty()) m.spec.active |= params_named(c.term);
    m = ranked_model(m.spec, nullptr, m.site, m.readout);
    const VecX still = ratios_of(rank_parameters(linearise(some_plan(), some_model())));
    m.spec.noise = c.noise;
    const Ranking r = rank_parameters(linearise(some_plan(), m, 3));
    const EstimateResult ekf = ekf_after(some_plan(), m);
    ASSERT_EQ(ekf.status, EstimateStatus::ok) << c.name;
    EXPECT_LT(farthest(ratios_of(r), ratios_of(ekf)), 1e-8) << c.name;
    EXPECT_LT((r.covariance - ekf.covariance).cwiseAbs().maxCoeff(), 1e-9) << c.name;
    EXPECT_GT(farthest(ratios_of(r), still), 0.1) << c.name << ": noise that tells";
    const bool walking = c.noise.drift_random_walk > 0.0 || !c.term.empty();
    EXPECT_EQ(r.walking.size(), walking ? 3u : 0u) << c.name;
  }
}

/// One position held level, and the gimbals alone, which show what drifts about the vertical.
struct AboutTheVertical {
  TestPlan plan;
  RankedModel model = model_of(Coupling::eq5, {"D_F"});

  AboutTheVertical(double dwell, double sample, double noise)
      : plan(plan_of("six", CommandLaw::level, dwell, sample)) {
    plan.positions.resize(1);
    model.readout.accelerometers = false;
    model.readout.gimbal_noise = noise;
  }
  /// Of the drift of gyro x, whose axis is vertical there [rad/s].
  double sigma() const {
    return rank_parameters(linearise(plan, model)).parameters[0].posterior_sigma;
  }
};

TEST(ProcessNoise, AWalkingDriftSettlesWhereRiccatiSays) {
  // psi' = d, d' = q w, psi read with density R: sigma_d^2 = sqrt(2) q^(3/2) R^(1/4) at rest, once
  // the filter's time, R^(1/4) q^(-1/2) = 55 s, is over, and samples are short beside it.
  AboutTheVertical scene(1200.0, 1.0, 5.0 * arcsec);
  const double q = 0.1 * deg_per_h * per_sqrt_h, R = std::pow(5.0 * arcsec, 2);
  scene.model.spec.noise.drift_random_walk = q;
  const double expected = std::sqrt(std::sqrt(2.0) * std::pow(q, 1.5) * std::pow(R, 0.25));
  EXPECT_NEAR(scene.sigma() / expected, 1.0, 0.03);
  scene.model.spec.noise = {};
  EXPECT_LT(scene.sigma(), 0.1 * expected) << "what it is without the walk";
}

TEST(ProcessNoise, OfAWalkingAngleTheWayTellsTheDrift) {
  // An angle that is read well: d = (psi(t) - psi(0)) / t, sigma_d = N / sqrt(t).
  AboutTheVertical scene(3600.0, 60.0, 0.01 * arcsec);
  const double N = 0.01 * detail::deg * per_sqrt_h;
  scene.model.spec.noise.angle_random_walk = N;
  EXPECT_NEAR(scene.sigma() / (N / 60.0), 1.0, 0.02);
}

TEST(ProcessNoise, ThatIsHardlyThereChangesNothing) {
  RankedModel still = model_of(Coupling::eq6);
  still.readout.gimbals = false;  // which show the attitude at a caging
  const RankedModel moved =
      with_noise(still, {.angle_random_walk = 1e-6 * walks().angle_random_walk,
                         .drift_random_walk = 1e-6 * walks().drift_random_walk});
  const LinearisedPlan a = linearise(some_plan(), still, 3), b = linearise(some_plan(), moved, 3);
  ASSERT_EQ(a.bins.size(), b.bins.size());
  const Ranking r = rank_parameters(a), s = rank_parameters(b);
  EXPECT_LT(farthest(ratios_of(s), ratios_of(r)), 1e-3);
  EXPECT_NEAR(s.bits, r.bits, 1e-2);
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    EXPECT_NEAR(s.parameters[k].conditional_sigma / r.parameters[k].conditional_sigma, 1.0, 1e-3);
  EXPECT_EQ(s.unseen.size(), r.unseen.size());
  EXPECT_EQ(s.unheld.size(), r.unheld.size()) << "attitudes that nobody knows at cagings";
  const VecX wide_a = posterior_of(a, 1e-4).sigma, wide_b = posterior_of(b, 1e-4).sigma;
  EXPECT_LT(farthest(wide_b, wide_a), 1e-3);
  EXPECT_GT(farthest(wide_a, ratios_of(r)), 0.05) << "that is another question";
  const InformationCourse c = information_course(a), d = information_course(b);
  EXPECT_LT((c.gain - d.gain).cwiseAbs().maxCoeff(), 1e-2);
  EXPECT_LT((c.loss - d.loss).cwiseAbs().maxCoeff(), 1e-2);
  const Drivers e = drivers_of(a, some_plan(), still), f = drivers_of(b, some_plan(), moved);
  EXPECT_LT((e.priors - f.priors).cwiseAbs().maxCoeff(), 1e-3);
  for (const VecX Drivers::*part :
       {&Drivers::accelerometers, &Drivers::gimbals, &Drivers::attitude, &Drivers::process_noise})
    EXPECT_LT((e.*part - f.*part).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(ProcessNoise, ThePlanWithoutAPositionIsThatOfAFilterThatDoesNotReadThere) {
  const RankedModel m = with_noise(some_model(), walks());
  const LinearisedPlan plan = linearise(some_plan(), m, 2);
  const InformationCourse course = information_course(plan);
  const VecX all = ratios_of(rank_parameters(plan)).array().log2();
  EXPECT_LT((course.gain.rowwise().sum() + all).cwiseAbs().maxCoeff(), 1e-9);
  double most = 0.0;
  for (int p = 0; p < plan.positions; ++p) {
    const VecX loss = ratios_of(ekf_after(some_plan(), m, p)).array().log2() - all.array();
    EXPECT_LT((course.loss.col(p) - loss).cwiseAbs().maxCoeff(), 1e-6) << p;
    most = std::max(most, loss.maxCoeff());
  }
  EXPECT_GT(most, 0.5);
}

TEST(ProcessNoise, DriversAreThoseOfAPlanRankedWithTheHalf) {
  const RankedModel m = with_noise(some_model(), walks());
  const LinearisedPlan plan = linearise(some_plan(), m);
  const Drivers d = drivers_of(plan, some_plan(), m);
  const auto sigmas_of = [](const RankedModel& model) {
    const Ranking r = rank_parameters(linearise(some_plan(), model));
    VecX all(static_cast<Eigen::Index>(r.parameters.size()));
    for (std::size_t k = 0; k < r.parameters.size(); ++k)
      all[static_cast<Eigen::Index>(k)] = r.parameters[k].posterior_sigma;
    return all;
  };
  const VecX before = sigmas_of(m);
  for (Eigen::Index j = 0; j < before.size(); ++j) {
    RankedModel better = m;
    const std::size_t p = plan.layout.params[static_cast<std::size_t>(j)];
    better.spec.priors[p] = normal(m.spec.priors[p].mean(), 0.5 * m.spec.priors[p].sigma());
    EXPECT_LT((d.priors.col(j) - sigmas_of(better).cwiseQuotient(before)).cwiseAbs().maxCoeff(),
              1e-6)
        << j;
  }
  const RankedModel half = with_noise(m, {.angle_random_walk = 0.5 * walks().angle_random_walk,
                                          .drift_random_walk = 0.5 * walks().drift_random_walk});
  EXPECT_LT((d.process_noise - sigmas_of(half).cwiseQuotient(before)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(d.process_noise.minCoeff(), 0.8);
  RankedModel attitude = m;
  attitude.spec.initial_attitude *= 0.5;
  EXPECT_LT((d.attitude - sigmas_of(attitude).cwiseQuotient(before)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ProcessNoise, OfTermsIsWhatTheFilterAllowsForWhateverTheTruth) {
  FilterSpec filter = base_filter(Coupling::eq5);
  filter.active = only({"D_F"}) | params_named("drift_random_walk");
  filter.priors[param("q_x")] = normal(3e-9, 4e-9);
  TruthSpec truth = base_truth(Coupling::eq5);
  truth.active = filter.active;
  truth.priors[param("q_x")] = fixed(7e-9);
  const RankedModel m = ranked_model(filter, &truth, harbin, Readout{});
  EXPECT_NEAR(m.nominal[param("q_x")], 5e-9, 1e-20);  // root mean square
}

}  // namespace
}  // namespace drift::process_noise_test
