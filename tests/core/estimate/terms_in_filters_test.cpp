// Every term in the estimators: Jacobians, and recovery of what the truth has. How well truth and
// filter match over many runs: tests/mc/terms_in_studies_test.cpp.
#include <gtest/gtest.h>

#include <map>

#include "core/physics/stochastic.hpp"
#include "tests/support/estimators.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::terms_in_filters_test {
namespace {

using namespace drift::test;

/// A filter with D_F, eta and one term, of which everything that may be a state is one.
FilterSpec filter_with(std::size_t term) {
  FilterSpec filter = base_filter(coupling_for(term));
  filter.active = only({"D_F", "eta"}) | term_params(term);
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (TermLibrary::specs[i].continuous())
      filter.priors[i] = normal(filter.priors[i].a, 0.2 * filter.priors[i].a);
  return filter;
}

TEST(EveryTermInAFilter, HasTheJacobianOfItsPrediction) {
  // Central differences of `predict` with steps of 1e-3 prior sigma. As for the base terms
  // (Sensitivity.EquationsOfMotionAgreeWithDifferences): the quadrature adds (0.05 rad)^4 in slews.
  // A time constant is less linear: 0.2^2 * 1e-6.
  for (const auto mode : {CommandLaw::level, CommandLaw::free}) {
    const Timeline timeline = scene("slew12", mode);
    const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
    const Readout readout;
    const std::vector<Vec3> psi(timeline.chains, Vec3(4e-4, -3e-4, 5e-4));
    for (const std::size_t t : visible_terms()) {
      const FilterSpec filter = filter_with(t);
      const DriftModel model = filter.model();
      const Layout layout = make_layout(filter);
      Theta theta = layout.theta;
      theta[param("D_F_y")] = 0.4 * deg_per_h;
      theta[param("eta_z")] = 70.0 * arcsec;
      set_term(theta, t);
      const Measurements here = predict(timeline, model, theta, psi, readout);
      const MatX rows = measurement_equations({timeline, readout, here}, model, layout, theta,
                                              integrate_fixed(timeline, model, theta, psi),
                                              filter.initial_attitude)
                            .front()
                            .rows;
      EXPECT_LT(rows.rightCols<1>().cwiseAbs().maxCoeff(), 1e-6)
          << TermLibrary::terms[t].key << ": equations and prediction differ";
      const double h = 1e-3;
      for (std::size_t k = 0; k < layout.size(); ++k) {
        Theta up = theta, down = theta;
        up[layout.params[k]] += h * layout.sigma[k];
        down[layout.params[k]] -= h * layout.sigma[k];
        const Measurements a = predict(timeline, model, up, psi, readout);
        const Measurements b = predict(timeline, model, down, psi, readout);
        const VecX column = rows.col(3 + static_cast<Eigen::Index>(k));
        double worst = 0.0;
        Eigen::Index row = 0;
        for (Eigen::Index i = 0; i < n; ++i) {
          for (int c = 0; c < 3; ++c, ++row)
            worst = std::max(worst, std::abs((a.acc(c, i) - b.acc(c, i)) / (2.0 * h) /
                                                 readout.accelerometer_noise -
                                             column[row]));
          for (int c = 0; c < 3; ++c, ++row)
            worst = std::max(worst, std::abs(angle_difference(a.gimbal(c, i), b.gimbal(c, i)) /
                                                 (2.0 * h) / readout.gimbal_noise -
                                             column[row]));
        }
        EXPECT_LT(worst, 5e-4 * column.cwiseAbs().maxCoeff() + 1e-6)
            << TermLibrary::specs[layout.params[k]].key.view() << " of "
            << TermLibrary::terms[t].key;
      }
    }
  }
}

/// Truth with noise, and every estimator on it.
struct Recovery {
  Timeline timeline;
  FilterSpec filter = base_filter(Coupling::eq6);
  Theta theta;
  std::map<std::string_view, EstimateResult> by;

  Recovery(std::string_view preset, CommandLaw mode, std::initializer_list<std::string_view> keys,
           std::initializer_list<std::pair<std::string_view, double>> values,
           std::initializer_list<std::pair<std::string_view, Prior>> priors = {})
      : timeline(scene(preset, mode, 1800.0)) {
    TruthSpec truth = base_truth(Coupling::eq6);
    truth.active = TermLibrary::completed(only(keys));
    const Readout readout;
    theta = draw_parameters(truth, 3, 0, Purpose::parameters);
    for (const auto& [key, value] : values) theta[param(key)] = value;
    TruthDraw draw = draw_truth(truth, timeline.chains, 3, 0);
    draw.theta = theta;
    const Simulation sim = Simulator(truth, readout).run(timeline, draw, 3, 0);
    filter.active = truth.active;
    for (const auto& [key, prior] : priors) filter.priors[param(key)] = prior;
    const Theta start = make_layout(filter).theta;
    for (const Estimator& estimator : every_estimator)
      by[estimator.name] = estimator.run(filter, timeline, readout, sim.measured, start);
  }

  /// Largest error in sigma over all states, and chi-square per degree of freedom within its band:
  /// (2/N)^0.5 is 0.015 for the 9000 scalars of these tests; 5 of them, and nonlinearity for the
  /// EKF.
  void check(double chi2_band) const {
    for (const auto& [estimator, result] : by) {
      EXPECT_EQ(result.status, EstimateStatus::ok) << estimator << result.cause;
      EXPECT_NEAR(result.statistic_per_dof(), 1.0, chi2_band) << estimator;
      for (const ParameterEstimate& p : result.parameters)
        EXPECT_LT(std::abs(p.value - theta[p.param]), 4.0 * p.sigma)
            << estimator << TermLibrary::specs[p.param].key.view();
    }
  }
  const ParameterEstimate& of(std::string_view estimator, std::string_view key) const {
    return *by.at(estimator).find(param(key));
  }
};

TEST(TermWithMemory, IsRecoveredWithItsTimeConstant) {
  const Recovery r("slew12", CommandLaw::level, {"D_F", "D_I", "s", "heat"},
                   {{"heat_x", 0.08 * deg_per_h},
                    {"heat_y", -0.06 * deg_per_h},
                    {"heat_z", 0.05 * deg_per_h},
                    {"heat_tau", 17.0 * 60.0}},
                   {{"heat_tau", normal(14.0 * 60.0, 5.0 * 60.0)}});
  r.check(0.08);
  const ParameterEstimate& tau = r.of("batch", "heat_tau");
  EXPECT_LT(tau.sigma, 0.5 * tau.prior_sigma);
  EXPECT_NEAR(r.of("ekf", "heat_tau").value, tau.value, tau.sigma);
  // A Gauss-Newton step from the EKF leaves an error of second order in the EKF's own.
  EXPECT_NEAR(r.of("iterated", "heat_tau").value, tau.value, 0.25 * tau.sigma);
}

TEST(TermInTheGimbals, IsRecovered) {
  const Recovery r(
      "slew12", CommandLaw::free,
      {"D_F", "D_I", "enc_s1", "enc_c1", "enc_s2", "enc_c2", "enc_sn", "enc_cn", "skew"}, {});
  r.check(0.08);
  EXPECT_LT(r.of("batch", "enc_s2_inner").learning_ratio(), 0.5);
}

TEST(TermInTheAttitude, IsRecovered) {
  const Recovery r("slew12", CommandLaw::free, {"D_F", "D_I", "F", "H_u"}, {});
  r.check(0.08);
  EXPECT_LT(r.of("batch", "F_outer").learning_ratio(), 0.5);
}

TEST(DriftRandomWalk, IsProcessNoiseOfItsGyroAlone) {
  const Timeline timeline = scene("six", CommandLaw::level, 1800.0);
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active = only({"D_F"}) | params_named("drift_random_walk");
  for (const char* key : {"q_x", "q_y", "q_z"}) truth.priors[param(key)] = fixed(0.0);
  truth.priors[param("q_y")] = fixed(0.05 * deg_per_h / 60.0);
  const Simulation sim = Simulator(truth, {}).run(timeline, 1, 0);
  EXPECT_NE(sim.theta_end[param("D_F_y")], sim.draw.theta[param("D_F_y")]);
  EXPECT_EQ(sim.theta_end[param("D_F_x")], sim.draw.theta[param("D_F_x")]);
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.active = truth.active;
  filter.priors = truth.priors;
  FilterSpec blind = filter;
  blind.active = only({"D_F"});
  for (const Estimator& estimator : sequential_estimators) {
    SCOPED_TRACE(estimator.name);
    const Theta start = make_layout(filter).theta;
    const EstimateResult with = estimator.run(filter, timeline, {}, sim.measured, start);
    const EstimateResult without = estimator.run(blind, timeline, {}, sim.measured, start);
    EXPECT_GT(with.find(param("D_F_y"))->sigma, 2.0 * without.find(param("D_F_y"))->sigma);
    EXPECT_NEAR(with.statistic_per_dof(), 1.0, 0.15);
    EXPECT_GT(without.statistic_per_dof(), 1.5);
  }
}

TEST(BistableDrift, JumpsBetweenTwoLevelsAndAFilterAllowsForIt) {
  const Timeline timeline = scene("six", CommandLaw::level, 3600.0);
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active = only({"D_F"}) | params_named("bistable_drift");
  const double B = 0.03 * deg_per_h;
  for (const char* key : {"B_x", "B_y", "B_z"}) truth.priors[param(key)] = fixed(B);
  truth.priors[param("D_F_x")] = truth.priors[param("D_F_y")] = truth.priors[param("D_F_z")] =
      fixed(0.0);
  const Simulation sim = Simulator(truth, {}).run(timeline, 4, 0);
  // In a level dwell the attitude about the vertical axis moves at -+B.
  int high = 0, low = 0;
  for (std::size_t i = 0; i < 120; ++i) {  // x vertical
    const Interval& n = timeline.intervals[i];
    const double rate = (sim.phi[n.last_node()].x() - sim.phi[n.first_node].x()) / n.length();
    (rate > 0.0 ? low : high)++;
    // Attitude errors of 200 arcsec and what drifts about the other axes pick up Earth rate: 0.01
    // deg/h.
    EXPECT_NEAR(std::abs(rate), B, 0.02 * deg_per_h);
  }
  EXPECT_GT(high * low, 0);
  // What an estimate at the end is to be compared with.
  EXPECT_EQ(std::abs(sim.theta_end[param("D_F_x")]), B);
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.active = truth.active;
  for (const char* key : {"B_x", "B_y", "B_z"}) filter.priors[param(key)] = fixed(B);
  FilterSpec blind = filter;
  blind.active = only({"D_F"});
  for (const Estimator& estimator : sequential_estimators) {
    SCOPED_TRACE(estimator.name);
    const Theta start = make_layout(filter).theta;
    const EstimateResult with = estimator.run(filter, timeline, {}, sim.measured, start);
    const EstimateResult without = estimator.run(blind, timeline, {}, sim.measured, start);
    EXPECT_GT(without.statistic_per_dof(), 1.5 * with.statistic_per_dof());
    EXPECT_LT(with.statistic_per_dof(), 1.2);
    EXPECT_GT(with.statistic_per_dof(), 0.6);
  }
}

TEST(Outliers, AreLeftOutByTheGate) {
  const Timeline timeline = scene("six", CommandLaw::free, 3600.0);
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active = only({"D_F", "D_I"}) | params_named("outliers");
  truth.priors[param("outlier_rate")] = fixed(0.01);
  const Simulation sim = Simulator(truth, {}).run(timeline, 5, 0);
  FilterSpec filter = base_filter(Coupling::eq6);
  const auto worst = [&](const EstimateResult& r) {
    double z = 0.0;
    for (const ParameterEstimate& p : r.parameters)
      z = std::max(z, std::abs(p.value - sim.draw.theta[p.param]) / p.sigma);
    return z;
  };
  for (const bool gated : {false, true}) {
    filter.active = only({"D_F", "D_I"});
    if (gated) filter.active |= params_named("outliers");
    const Theta start = make_layout(filter).theta;
    for (const Estimator& estimator : every_estimator) {
      SCOPED_TRACE(estimator.name);
      const EstimateResult r = estimator.run(filter, timeline, {}, sim.measured, start);
      if (gated) {
        EXPECT_LT(worst(r), 4.0);
        EXPECT_NEAR(r.statistic_per_dof(), 1.0, 0.1);
        // 2160 samples, 1 % wrong, of which 13 % are within 5 of 30 sigma: 19 +- 4.3; three sigma.
        EXPECT_NEAR(2160.0 - static_cast<double>(r.measured), 19.0, 13.0);
      } else {
        EXPECT_GT(r.statistic_per_dof(), 1.5);
      }
    }
  }
}

TEST(Layout, HasNoStatesForWhatIsRandomOrDiscrete) {
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.active =
      params_named("drift_random_walk") | params_named("encoder_harmonics") | only({"D_F"});
  filter.priors[param("enc_n")] = normal(16.0, 1.0);
  filter.priors[param("q_x")] = normal(3e-9, 4e-9);
  const Layout layout = make_layout(filter);
  EXPECT_EQ(layout.size(), 3u + 18u);
  EXPECT_EQ(layout.num_rate, 3u);
  EXPECT_EQ(layout.theta[param("enc_n")], 16.0);
  EXPECT_NEAR(layout.theta[param("q_x")], 5e-9, 1e-20);  // root mean square
}

}  // namespace
}  // namespace drift::terms_in_filters_test
