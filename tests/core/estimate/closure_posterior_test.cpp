#include "core/estimate/closure/closure_posterior.hpp"

#include <gtest/gtest.h>

#include "core/sim/simulate.hpp"
#include "mc/task/campaign.hpp"
#include "tests/support/few_slews.hpp"

namespace drift::closure_posterior_test {
namespace {

using namespace drift::test;

struct Scene {
  TruthSpec truth = with_lambda(base_truth(Coupling::lambda));
  FilterSpec filter = with_lambda(base_filter(Coupling::lambda));
  Timeline timeline = lay_out(few_slews(), in_the_south);
  Readout readout{.accelerometer_noise = 3e-5, .gimbal_noise = 8.0 * arcsec};

  Simulation simulated(std::uint64_t run) const {
    return Simulator(truth, readout).run(timeline, 5, run);
  }
  EstimateResult estimate(const Measurements& measured) const {
    const MeasuredTest test{timeline, readout, measured};
    return over_closure(filter, test, fit_batch(filter, test, make_layout(filter).theta));
  }
};

/// Error over covariance, squared, per parameter.
double nees_of(const EstimateResult& e, const Theta& truth) {
  VecX error(static_cast<Eigen::Index>(e.parameters.size()));
  for (std::size_t k = 0; k < e.parameters.size(); ++k) {
    const ParameterEstimate& p = e.parameters[k];
    error[static_cast<Eigen::Index>(k)] = (p.value - truth[p.param]) / p.prior_sigma;
  }
  return error.dot(e.covariance.ldlt().solve(error)) / static_cast<double>(error.size());
}

TEST(ClosurePosterior, ErrorsAreAsLargeAsItSaysWhereTheCurvatureAtTheTopIsNot) {
  // Where truths are drawn from the prior, mean and covariance of the posterior have a NEES of one
  // for each parameter in the mean over truths and data, whatever the posterior's shape.
  constexpr std::size_t runs = 120;
  const Scene s;
  struct Both {
    double top, moments;
  };
  const auto nees = mc::run_campaign(runs, [&](std::size_t run) {
    const Simulation sim = s.simulated(run);
    const MeasuredTest test{s.timeline, s.readout, sim.measured};
    const BatchResult fit = fit_batch(s.filter, test, make_layout(s.filter).theta);
    return Both{nees_of(fit.estimate, sim.draw.theta),
                nees_of(over_closure(s.filter, test, fit), sim.draw.theta)};
  });
  double top = 0.0, mean = 0.0, square = 0.0;
  for (const Both& b : nees) {
    top += b.top / runs;
    mean += b.moments / runs;
    square += b.moments * b.moments / runs;
  }
  const double of_the_mean = std::sqrt((square - mean * mean) / runs);
  std::printf("NEES/dof %.3f +- %.3f; of the curvature at the top %.1f\n", mean, of_the_mean, top);
  EXPECT_NEAR(mean, 1.0, 3.0 * of_the_mean);
  EXPECT_LT(of_the_mean, 0.1);
  EXPECT_GT(top, 5.0);  // else this function would not be needed
}

TEST(ClosurePosterior, IsTheSumOverFitsWithLambdaHeldAtManyValues) {
  const Scene s;
  const Simulation sim = s.simulated(3);
  const MeasuredTest test{s.timeline, s.readout, sim.measured};
  const EstimateResult got = s.estimate(sim.measured);
  const Layout layout = make_layout(s.filter);
  const auto n = static_cast<Eigen::Index>(layout.size());
  double mass = 0.0, most = 0.0;
  VecX first = VecX::Zero(n), second = VecX::Zero(n);
  constexpr int points = 301;
  for (int i = 0; i < points; ++i) {
    const double x_lambda = -4.5 + 9.0 * i / (points - 1);
    FilterSpec held = s.filter;
    const double lambda = of_lambda.a + of_lambda.b * x_lambda;
    held.priors[closure_param] = fixed(lambda);
    const BatchResult fit = fit_batch(held, test, make_layout(held).theta);
    ASSERT_EQ(fit.estimate.status, EstimateStatus::ok);
    // |P| of the parameters alone: that of the attitudes hardly knows lambda.
    const double log = -0.5 * (fit.estimate.statistic + x_lambda * x_lambda) +
                       0.5 * std::log(fit.estimate.covariance.determinant());
    if (i == 0) most = log;
    const double p = std::exp(log - most);
    mass += p;
    for (Eigen::Index k = 0; k < n; ++k) {
      const ParameterEstimate* e = fit.estimate.find(layout.params[k]);
      const double x = e ? (e->value - layout.mean[k]) / layout.sigma[k] : x_lambda;
      const double sigma = e ? e->sigma / layout.sigma[k] : 0.0;
      first[k] += p * x;
      second[k] += p * (x * x + sigma * sigma);
    }
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    const double mean = first[k] / mass, sigma = std::sqrt(second[k] / mass - mean * mean);
    const ParameterEstimate& e = got.parameters[k];
    const auto key = TermLibrary::specs[e.param].key.view();
    // No interval holds more than a sixth of the mass or of a variance: to a few percent.
    EXPECT_NEAR((e.value - e.prior_mean) / e.prior_sigma, mean, 0.05 * sigma) << key;
    EXPECT_NEAR(e.sigma / e.prior_sigma / sigma, 1.0, 0.05) << key;
  }
}

TEST(ClosurePosterior, WhatAFitLeftOutAsAnOutlierIsLeftOut) {
  Scene s;
  s.filter.active |= params_named("outliers");
  Simulation sim = s.simulated(3);
  sim.measured.acc(1, 4) += 1000.0 * s.readout.accelerometer_noise;
  const EstimateResult with = s.estimate(sim.measured);
  sim.measured.acc(1, 4) = std::nan("");
  const EstimateResult without = s.estimate(sim.measured);
  for (std::size_t k = 0; k < with.parameters.size(); ++k) {
    const ParameterEstimate &a = with.parameters[k], &b = without.parameters[k];
    // To the tolerance of the fits (1e-4 sigma), with the points of lambda at other places.
    EXPECT_NEAR(a.value, b.value, 1e-2 * b.sigma);
    EXPECT_NEAR(a.sigma, b.sigma, 1e-2 * b.sigma);
  }
}

/// From starts on both sides a fit may end in a side valley; what is told of it is not.
TEST(ClosurePosterior, TheStatisticIsThatOfTheDeepestPointWhateverTheStart) {
  const Scene s;
  constexpr std::size_t runs = 60;
  struct Both {
    double fits, told;  ///< differences of the two starts
  };
  const auto apart = mc::run_campaign(runs, [&](std::size_t run) {
    const Simulation sim = s.simulated(run);
    const MeasuredTest test{s.timeline, s.readout, sim.measured};
    Theta far = make_layout(s.filter).theta;
    far[closure_param] = 3.0;
    for (const char* const key : {"eta_x", "eta_y", "eta_z", "xi_x", "xi_y", "xi_z"}) {
      const std::size_t i = *TermLibrary::find(key);
      far[i] += (run % 2 == 0 ? 2.0 : -2.0) * s.filter.priors[i].sigma();
    }
    const BatchResult a = fit_batch(s.filter, test, make_layout(s.filter).theta),
                      b = fit_batch(s.filter, test, far);
    if (a.estimate.status != EstimateStatus::ok || b.estimate.status != EstimateStatus::ok)
      return Both{0.0, 0.0};
    return Both{std::abs(a.estimate.statistic - b.estimate.statistic),
                std::abs(over_closure(s.filter, test, a).statistic -
                         over_closure(s.filter, test, b).statistic)};
  });
  double fits = 0.0, told = 0.0;
  for (const Both& b : apart) {
    fits = std::max(fits, b.fits);
    told = std::max(told, b.told);
  }
  std::printf("largest difference: of fits %.2f, as told %.2f\n", fits, told);
  EXPECT_GT(fits, 1.0) << "no fit ended in a side valley: nothing is tried";
  EXPECT_LT(told, 0.1);
}

TEST(ClosurePosterior, AFilterWithoutLambdaIsLeftAsItIs) {
  Scene s;
  s.filter = base_filter(Coupling::eq5);
  const Simulation sim = s.simulated(3);
  const MeasuredTest test{s.timeline, s.readout, sim.measured};
  const BatchResult fit = fit_batch(s.filter, test, make_layout(s.filter).theta);
  const EstimateResult same = over_closure(s.filter, test, fit);
  EXPECT_EQ(same.covariance, fit.estimate.covariance);
  for (std::size_t k = 0; k < same.parameters.size(); ++k)
    EXPECT_EQ(same.parameters[k].value, fit.estimate.parameters[k].value);
}

TEST(ClosurePosterior, IsOneForFitsThatEndedAtOnePoint) {
  const Scene s;
  Simulation sim = s.simulated(3);
  const MeasuredTest test{s.timeline, s.readout, sim.measured};
  Theta other = make_layout(s.filter).theta;
  constexpr auto drift = TermLibrary::index("D_F_x");
  other[drift] += s.filter.priors[drift].b;
  const BatchResult a = fit_batch(s.filter, test, make_layout(s.filter).theta);
  const BatchResult b = fit_batch(s.filter, test, other);
  ASSERT_TRUE(ended_at_one_point(a, b));
  const EstimateResult taken = with_moments_of(over_closure(s.filter, test, a), b);
  const EstimateResult own = over_closure(s.filter, test, b);
  EXPECT_EQ(taken.parameters[0].start, b.estimate.parameters[0].start);
  for (std::size_t k = 0; k < own.parameters.size(); ++k) {
    const ParameterEstimate &p = taken.parameters[k], &q = own.parameters[k];
    // The points of lambda lie as far apart as the fits do, 2e-4 sigma at most.
    EXPECT_NEAR(p.value, q.value, 1e-3 * q.sigma) << k;
    EXPECT_NEAR(p.sigma, q.sigma, 1e-3 * q.sigma) << k;
  }
  BatchResult off = b;
  off.estimate.parameters[0].value += 3e-4 * a.estimate.parameters[0].sigma;
  EXPECT_FALSE(ended_at_one_point(a, off));
  sim.measured.acc(1, 4) = std::nan("");
  EXPECT_FALSE(ended_at_one_point(a, fit_batch(s.filter, test, other)));
}

}  // namespace
}  // namespace drift::closure_posterior_test
