// The two estimators on simulated tests: agreement, degeneracies, consistency.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/estimate/batch.hpp"
#include "core/estimate/sequential/ekf.hpp"
#include "mc/task/campaign.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::estimators_test {
namespace {

using namespace drift::test;

struct SimulatedTest {
  Timeline timeline;
  Readout readout;
  Simulation sim;
  SimulatedTest(const char* preset, CommandLaw mode, const TruthSpec& truth, std::uint64_t run = 1,
                double dwell = 3600.0)
      : timeline(preset_timeline(preset, mode, dwell)),
        sim(Simulator(truth, readout).run(timeline, 1, run)) {}
};

TEST(Estimators, EkfAndBatchAgreeWhereTheTestSeesTheParameter) {
  for (const auto& [preset, mode] :
       {std::pair{"six", CommandLaw::free}, {"eighteen", CommandLaw::level}}) {
    const TruthSpec truth = base_truth(Coupling::eq5);
    const FilterSpec filter = base_filter(Coupling::eq5);
    const SimulatedTest t(preset, mode, truth);
    const Theta start = make_layout(filter).theta;
    const EstimateResult ekf = run_ekf(filter, {t.timeline, t.readout, t.sim.measured}, start);
    const BatchResult batch = fit_batch(filter, {t.timeline, t.readout, t.sim.measured}, start);
    ASSERT_EQ(ekf.status, EstimateStatus::ok);
    ASSERT_EQ(batch.estimate.status, EstimateStatus::ok);
    for (std::size_t k = 0; k < ekf.parameters.size(); ++k) {
      const ParameterEstimate &e = ekf.parameters[k], &b = batch.estimate.parameters[k];
      if (b.learning_ratio() > 0.5) continue;  // not observable in this test
      const auto key = TermLibrary::specs[e.param].key.view();
      EXPECT_LT(std::abs(e.value - b.value), 0.1 * b.sigma) << key << " " << preset;
      EXPECT_NEAR(e.sigma / b.sigma, 1.0, 0.02) << key << " " << preset;
    }
  }
}

TEST(Estimators, BatchDoesNotDependOnItsStart) {
  const TruthSpec truth = base_truth(Coupling::eq6);
  const FilterSpec filter = base_filter(Coupling::eq6);
  const SimulatedTest t("twelve", CommandLaw::free, truth);
  std::vector<BatchResult> fits;
  for (std::uint64_t start = 0; start < 2; ++start)
    fits.push_back(fit_batch(filter, {t.timeline, t.readout, t.sim.measured},
                             draw_parameters(filter, 3, start, Purpose::filter_start)));
  for (std::size_t k = 0; k < fits[0].estimate.parameters.size(); ++k) {
    const auto &a = fits[0].estimate.parameters[k], &b = fits[1].estimate.parameters[k];
    EXPECT_LT(std::abs(a.value - b.value), 1e-3 * a.sigma)
        << TermLibrary::specs[a.param].key.view();
  }
}

/// Dimension of the null space of the data, and the share of a direction that lies in it.
struct NullSpace {
  Layout layout;
  std::vector<WeakDirection> directions;
  /// Linearised at the nominal attitudes, for given parameters.
  NullSpace(const char* preset, CommandLaw mode, Coupling coupling, const Theta& theta) {
    const ModelSpec spec = base_spec(coupling);
    const Timeline timeline = preset_timeline(preset, mode);
    const auto n = static_cast<Eigen::Index>(timeline.intervals.size());
    const Measurements zero{Mat3X::Zero(3, n), Mat3X::Zero(3, n)};
    layout = make_layout(spec);
    const std::vector<Vec3> psi(timeline.chains, Vec3::Zero());
    directions = weak_directions(
        information_root(
            measurement_equations({timeline, Readout{}, zero}, spec.model(), layout, theta,
                                  integrate_fixed(timeline, spec.model(), theta, psi),
                                  spec.initial_attitude),
            layout.size()),
        unseen_information);
  }
  double share(std::initializer_list<std::pair<const char*, double>> direction) const {
    VecX v = VecX::Zero(static_cast<Eigen::Index>(layout.size()));
    for (const auto& [key, si] : direction)
      for (std::size_t k = 0; k < layout.size(); ++k)
        if (layout.params[k] == param(key)) v[k] = si / layout.sigma[k];
    v.normalize();
    double inside = 0.0;
    for (const auto& d : directions) inside += std::pow(d.direction.dot(v), 2);
    return inside;
  }
};

TEST(Degeneracies, FixedDriftHidesInTheTraceOfTheQuadratics) {
  // a_I^2 + a_O^2 + a_S^2 = 1: three null directions in any 1 g test (physics.md 2.4).
  for (const auto& [preset, mode] :
       {std::pair{"eighteen", CommandLaw::level}, {"slew12", CommandLaw::free}}) {
    const NullSpace null(preset, mode, Coupling::eq5, random_theta(2));
    EXPECT_EQ(null.directions.size(), 3u) << preset;
    const double one = TermLibrary::specs[param("D_F_x")].unit.to_si;
    EXPECT_GT(null.share({{"D_F_x", one}, {"D_II_x", -one}, {"D_OO_x", -one}, {"D_SS_x", -one}}),
              0.999999);
    EXPECT_GT(null.share({{"D_F_z", one}, {"D_II_z", -one}, {"D_OO_z", -one}, {"D_SS_z", -one}}),
              0.999999);
    EXPECT_LT(null.share({{"D_F_x", one}}), 0.9);
  }
}

TEST(Degeneracies, CardinalLevelPositionsHideCubicScaleAndCrossTerms) {
  const NullSpace null("twentyfour", CommandLaw::level, Coupling::eq5, Theta::Zero());
  EXPECT_GT(null.share({{"K1_x", 1e-6}, {"K3_x", -1e-6}}), 0.99);
  EXPECT_GT(null.share({{"K_ip_y", 1.0}}), 0.99);
  EXPECT_GT(null.share({{"D_IS_z", 1.0}}), 0.99);
}

TEST(Degeneracies, UnderEquation6AFreePlatformDoesNotSeeMisalignment) {
  // Seen only through E w_l, which the quadratics of the other gyros span (physics.md 1.8).
  const NullSpace six("six", CommandLaw::free, Coupling::eq6, random_theta(2)),
      five("six", CommandLaw::free, Coupling::eq5, random_theta(2));
  EXPECT_EQ(six.directions.size(), five.directions.size() + 6);
}

/// Two-sided band that holds chi-square of m degrees over m with probability 1 - 2 tail, z of the
/// tail (Wilson-Hilferty, relative error below 1e-3 for m > 30).
std::pair<double, double> band(double m, double z) {
  const auto edge = [&](double s) {
    return std::pow(1.0 - 2.0 / (9.0 * m) + s * z * std::sqrt(2.0 / (9.0 * m)), 3);
  };
  return {edge(-1.0), edge(1.0)};
}

TEST(MatchedFilter, IsConsistentOver200Runs) {
  // Truth and filter share equation, terms and priors. NEES over all parameters and NIS over all
  // scalars inside their 95 % bands; coverage of 1 and 2 sigma inside its 95 % interval.
  constexpr std::size_t runs = 200;
  TruthSpec truth = base_truth(Coupling::eq5);
  FilterSpec filter = base_filter(Coupling::eq5);
  truth.active = filter.active =
      only({"D_F", "D_I", "D_O", "D_S", "eta", "xi", "K0", "K1", "dP", "dO"});
  const Timeline timeline = preset_timeline("twelve", CommandLaw::free, 1800.0);
  const Readout readout;
  const Layout layout = make_layout(filter);
  struct Outcome {
    double nees = 0.0, nis = 0.0;
    std::size_t measured = 0, within1 = 0, within2 = 0;
  };
  const auto outcomes = mc::run_campaign(runs, [&](std::size_t run) {
    const Simulation sim = Simulator(truth, readout).run(timeline, 11, run);
    const EstimateResult r = run_ekf(filter, {timeline, readout, sim.measured}, layout.theta);
    Outcome o;
    VecX e(static_cast<Eigen::Index>(layout.size()));
    for (std::size_t k = 0; k < layout.size(); ++k) {
      const double error = r.parameters[k].value - sim.draw.theta[layout.params[k]];
      e[k] = error / layout.sigma[k];
      const double z = std::abs(error) / r.parameters[k].sigma;
      o.within1 += z < 1.0;
      o.within2 += z < 2.0;
    }
    o.nees = e.dot(r.covariance.ldlt().solve(e));
    o.nis = r.statistic;
    o.measured = r.measured;
    return o;
  });
  double nees = 0.0, nis = 0.0, within1 = 0.0, within2 = 0.0, measured = 0.0;
  for (const Outcome& o : outcomes) {
    nees += o.nees;
    nis += o.nis;
    measured += static_cast<double>(o.measured);
    within1 += static_cast<double>(o.within1);
    within2 += static_cast<double>(o.within2);
  }
  const double n = static_cast<double>(layout.size());
  const auto nees_band = band(n * runs, 1.96), nis_band = band(measured, 1.96);
  std::printf(
      "NEES/n %.4f in [%.4f, %.4f]; NIS/m %.5f in [%.5f, %.5f]; coverage %.4f, %.4f of %.0f\n",
      nees / (n * runs), nees_band.first, nees_band.second, nis / measured, nis_band.first,
      nis_band.second, within1 / (n * runs), within2 / (n * runs), n * runs);
  EXPECT_GT(nees / (n * runs), nees_band.first);
  EXPECT_LT(nees / (n * runs), nees_band.second);
  EXPECT_GT(nis / measured, nis_band.first);
  EXPECT_LT(nis / measured, nis_band.second);
  // Parameters of one run are correlated; the interval counts runs, not run x parameter, for safety
  // against false alarms, and is still narrow enough to catch a sigma that is 10 % off.
  const double half1 = 1.96 * std::sqrt(0.6827 * 0.3173 / (runs * 6.0));
  const double half2 = 1.96 * std::sqrt(0.9545 * 0.0455 / (runs * 6.0));
  EXPECT_NEAR(within1 / (n * runs), 0.6827, half1);
  EXPECT_NEAR(within2 / (n * runs), 0.9545, half2);
}

TEST(CrossedFilter, Equation6OnDataOfEquation5IsBiasedAndSureOfIt) {
  // Torqued slews: eta is seen through lambda E, so the wrong equation answers with a wrong eta
  // (physics.md 1.8: "slew12 level, truth 5, filter 6: eta 143 sigma wrong").
  const TruthSpec truth = base_truth(Coupling::eq5);
  const SimulatedTest t("slew12", CommandLaw::level, truth);
  const FilterSpec wrong = base_filter(Coupling::eq6);
  const BatchResult fit =
      fit_batch(wrong, {t.timeline, t.readout, t.sim.measured}, make_layout(wrong).theta);
  double largest = 0.0;
  for (const char* key : {"eta_x", "eta_y", "eta_z"}) {
    const ParameterEstimate& e = *fit.estimate.find(param(key));
    largest = std::max(largest, std::abs(e.value - t.sim.draw.theta[e.param]) / e.sigma);
  }
  EXPECT_GT(largest, 20.0);
  EXPECT_GT(fit.estimate.statistic_per_dof(), 1.1);
}

TEST(CrossedFilter, LevelCagedTestsCannotTellTheEquationsApart) {
  // E enters identically to first order when Earth rate is torqued (physics.md 1.4).
  const TruthSpec truth = base_truth(Coupling::eq5);
  const SimulatedTest t("twentyfour", CommandLaw::level, truth, 1, 1800.0);
  double cost[2];
  for (const Coupling c : {Coupling::eq5, Coupling::eq6}) {
    const FilterSpec filter = base_filter(c);
    cost[c == Coupling::eq6] =
        fit_batch(filter, {t.timeline, t.readout, t.sim.measured}, make_layout(filter).theta)
            .estimate.statistic;
  }
  EXPECT_LT(std::abs(cost[0] - cost[1]), 25.0);  // second-order differences: below 5 sigma
}

TEST(LambdaFilter, FindsTheEquationThatMadeTheData) {
  for (const double lambda : {0.0, 1.0}) {
    const TruthSpec truth = base_truth(lambda == 0.0 ? Coupling::eq5 : Coupling::eq6);
    const SimulatedTest t("slew12", CommandLaw::free, truth);
    FilterSpec filter = base_filter(Coupling::lambda);
    filter.active.set(param("lambda"));
    const BatchResult fit =
        fit_batch(filter, {t.timeline, t.readout, t.sim.measured}, make_layout(filter).theta);
    const ParameterEstimate& e = *fit.estimate.find(param("lambda"));
    EXPECT_NEAR(e.value, lambda, 4.0 * e.sigma);
    EXPECT_LT(e.sigma, 0.1);
  }
}

TEST(Ekf, ReportsDivergenceAsAValue) {
  const TruthSpec truth = base_truth(Coupling::eq5);
  const FilterSpec filter = base_filter(Coupling::eq5);
  SimulatedTest t("six", CommandLaw::free, truth, 1, 600.0);
  t.sim.measured.acc.setConstant(1e9);
  const EstimateResult r =
      run_ekf(filter, {t.timeline, t.readout, t.sim.measured}, make_layout(filter).theta);
  EXPECT_EQ(r.status, EstimateStatus::diverged);
  EXPECT_FALSE(r.cause.empty());
}

TEST(Ekf, LeavesOutWhatWasNotMeasured) {
  const TruthSpec truth = base_truth(Coupling::eq5);
  const FilterSpec filter = base_filter(Coupling::eq5);
  SimulatedTest t("six", CommandLaw::free, truth, 1, 600.0);
  const auto n = static_cast<std::size_t>(t.timeline.intervals.size());
  const Theta start = make_layout(filter).theta;
  const auto count = [&] {
    return run_ekf(filter, {t.timeline, t.readout, t.sim.measured}, start).measured;
  };
  EXPECT_EQ(count(), 6 * n);
  t.sim.measured.acc(1, 3) = std::nan("");
  t.sim.measured.gimbal.col(5).setConstant(std::nan(""));
  EXPECT_EQ(count(), 6 * n - 4);
  const BatchResult batch = fit_batch(filter, {t.timeline, t.readout, t.sim.measured}, start);
  EXPECT_EQ(batch.estimate.measured, 6 * n - 4);
  EXPECT_EQ(batch.estimate.status, EstimateStatus::ok);
}

}  // namespace
}  // namespace drift::estimators_test
