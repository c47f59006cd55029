#include "core/estimate/sequential/iterated_passes.hpp"

#include <gtest/gtest.h>

#include "tests/support/estimators.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::iterated_passes_test {
namespace {

using namespace drift::test;

struct Fits {
  Layout layout;
  EstimateResult ekf;
  BatchResult batch;
  FilterEstimate iterated;
  Fits(const char* preset, const Timeline& timeline, Coupling coupling)
      : layout(make_layout(base_filter(coupling))) {
    const Simulation sim = Simulator(base_truth(coupling), Readout{}).run(timeline, 4, 2);
    EXPECT_TRUE(sim.ode.ok()) << preset;
    ekf = run_ekf(base_filter(coupling), {timeline, Readout{}, sim.measured}, layout.theta);
    batch = fit_batch(base_filter(coupling), {timeline, Readout{}, sim.measured}, layout.theta);
    iterated = IteratedPasses(base_filter(coupling), timeline, Readout{}, layout.theta)
                   .run(sim.measured, layout.theta);
  }
};

TEST(IteratedPasses, IsTheBatchFitWhereAnEkfIsNot) {
  // Torqued slews under eq. (6): misalignment times command and torquer scale times command. One
  // Gauss-Newton step from the EKF leaves an error of second order in the EKF's own: several times
  // less.
  const Timeline timeline = preset_timeline("slew12", CommandLaw::free, 3600.0, 300.0);
  Fits fits("slew12", timeline, Coupling::eq6);
  ASSERT_EQ(fits.iterated.status(), EstimateStatus::ok);
  ASSERT_EQ(fits.batch.estimate.status, EstimateStatus::ok);
  double ekf_off = 0.0, off = 0.0;
  for (std::size_t k = 0; k < fits.layout.size(); ++k) {
    const ParameterEstimate& b = fits.batch.estimate.parameters[k];
    const auto i = static_cast<Eigen::Index>(fits.layout.params[k]);
    off = std::max(off, std::abs(fits.iterated.theta()[i] - b.value) / b.sigma);
    EXPECT_NEAR(fits.iterated.sigma(k) / b.sigma, 1.0, 0.05)
        << TermLibrary::specs[b.param].key.view();
    ekf_off = std::max(ekf_off, std::abs(fits.ekf.parameters[k].value - b.value) / b.sigma);
  }
  std::printf("largest distance from the batch fit: EKF %.2f sigma, iterated %.2f sigma\n", ekf_off,
              off);
  EXPECT_LT(off, 0.5);
  EXPECT_LT(off, 0.25 * ekf_off);
  // Sum of NIS = minimum of data and prior cost, up to the attitude prior at caging.
  EXPECT_NEAR(fits.iterated.nis(), fits.batch.estimate.statistic, 0.5);
}

/// A linear pass about the minimum of the batch fit: the largest step it makes away from it, in
/// posterior sigmas, and the largest relative difference of a sigma.
struct AtTheMinimum {
  double step = 0.0, sigma = 0.0;
};

AtTheMinimum at_the_minimum(const char* preset, CommandLaw mode, Coupling truth_of,
                            Coupling coupling) {
  const Timeline timeline = preset_timeline(preset, mode, 3600.0, 180.0);
  const Simulation sim = Simulator(base_truth(truth_of), Readout{}).run(timeline, 4, 2);
  EXPECT_TRUE(sim.ode.ok());
  FilterSpec filter = base_filter(coupling);
  if (coupling == Coupling::lambda) filter.active.set(closure_param);
  const Layout layout = make_layout(filter);
  BatchOptions tight;
  tight.tolerance = 1e-6;
  const BatchResult fit =
      fit_batch(filter, {timeline, Readout{}, sim.measured}, layout.theta, tight);
  EXPECT_EQ(fit.estimate.status, EstimateStatus::ok);
  const Theta theta = theta_of(filter, fit);
  const Trajectory phi = integrate(timeline, filter.model(), theta, fit.psi0_l);
  IntervalRows pass(filter, timeline, Readout{});
  pass.reset(theta);
  Information information(layout.size(), pass.width());
  std::vector<double> rows(6 * pass.width());
  for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
    const Interval& interval = timeline.intervals[i];
    pass.enter(i);
    pass.look_ahead(i, i + 1, phi.data());
    if (interval.cage) pass.cage(interval, phi[interval.first_node]);
    const auto taken = pass.take(i, sim.measured.acc.col(static_cast<Eigen::Index>(i)),
                                 sim.measured.gimbal.col(static_cast<Eigen::Index>(i)), phi.data(),
                                 nullptr, rows.data());
    EXPECT_TRUE(taken.ok);
    information.add(rows.data(), 3 * taken.triples);
  }
  EXPECT_TRUE(information.factorise());
  const VecX x = information.solve(-layout.scaled(theta));  // the prior means, from the reference
  MatX P(x.size(), x.size());
  information.invert(P);
  AtTheMinimum out;
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const double sigma = fit.estimate.parameters[k].sigma;
    const auto i = static_cast<Eigen::Index>(k);
    out.step = std::max(out.step, std::abs(x[i]) * layout.sigma[i] / sigma);
    out.sigma = std::max(out.sigma, std::abs(layout.sigma[i] * std::sqrt(P(i, i)) / sigma - 1.0));
  }
  std::printf("%s, truth %s, filter %s: step %.1e posterior sigma, sigma off by %.1e\n", preset,
              key_of(truth_of).data(), key_of(coupling).data(), out.step, out.sigma);
  return out;
}

TEST(IteratedPasses, ALinearPassStandsStillAtTheMinimumOfTheBatchFit) {
  // Two implementations of one Gauss-Newton step: rows and their triangle, and rows whitened by a
  // filter of the attitude. The second takes the mean over an interval as seen from its middle: all
  // of it, in slews too.
  struct Case {
    const char* preset;
    CommandLaw mode;
    Coupling truth, filter;
  };
  for (const Case& c : {Case{"six", CommandLaw::free, Coupling::eq5, Coupling::eq5},
                        Case{"six", CommandLaw::free, Coupling::eq6, Coupling::eq6},
                        Case{"slew12", CommandLaw::free, Coupling::eq5, Coupling::eq5},
                        Case{"slew12", CommandLaw::free, Coupling::eq6, Coupling::eq6},
                        Case{"slew12", CommandLaw::free, Coupling::eq5, Coupling::eq6},
                        Case{"slew12", CommandLaw::free, Coupling::eq5, Coupling::lambda},
                        Case{"casespin", CommandLaw::free, Coupling::eq6, Coupling::eq6}}) {
    const AtTheMinimum at = at_the_minimum(c.preset, c.mode, c.truth, c.filter);
    EXPECT_LT(at.step, 1e-3) << c.preset;
    EXPECT_LT(at.sigma, 1e-6) << c.preset;
  }
}

TEST(IteratedPasses, IsTheBatchFitOverCagings) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 3600.0, 300.0);
  Fits fits("six", timeline, Coupling::eq5);
  for (std::size_t k = 0; k < fits.layout.size(); ++k) {
    const ParameterEstimate& b = fits.batch.estimate.parameters[k];
    if (b.learning_ratio() > 0.5) continue;
    const auto i = static_cast<Eigen::Index>(fits.layout.params[k]);
    EXPECT_LT(std::abs(fits.iterated.theta()[i] - b.value), 0.1 * b.sigma)
        << TermLibrary::specs[b.param].key.view();
    EXPECT_NEAR(fits.iterated.sigma(k) / b.sigma, 1.0, 0.01);
  }
  EXPECT_NEAR(fits.iterated.nis(), fits.batch.estimate.statistic, 0.5);
}

TEST(IteratedPasses, IsTheBatchFitWithEveryTerm) {
  // Two implementations of one minimum. The iterated EKF stops less than a Gauss-Newton step of a
  // sigma from it, and takes the mean output of an accelerometer as seen from the middle of its
  // interval: a tenth of a sigma in slews.
  const Timeline timeline = scene("slew12", CommandLaw::level, 300.0, 60.0);
  for (const std::size_t t : visible_terms()) {
    SCOPED_TRACE(TermLibrary::terms[t].key);
    FilterSpec filter = base_filter(coupling_for(t));
    filter.active = only({"D_F", "eta"}) | term_params(t);
    TruthSpec truth = base_truth(coupling_for(t));
    truth.active = filter.active;
    const Readout readout;
    TruthDraw draw = draw_truth(truth, timeline.chains, 3, 0);
    set_term(draw.theta, t);
    const Simulation sim = Simulator(truth, readout).run(timeline, draw, 3, 0);
    const Theta start = make_layout(filter).theta;
    const EstimateResult a = by_iterated_ekf(filter, timeline, readout, sim.measured, start);
    const EstimateResult b = by_batch(filter, timeline, readout, sim.measured, start);
    ASSERT_EQ(a.status, EstimateStatus::ok) << a.cause;
    ASSERT_EQ(b.status, EstimateStatus::ok) << b.cause;
    EXPECT_NEAR(a.statistic, b.statistic, 1.0);
    for (std::size_t k = 0; k < a.parameters.size(); ++k) {
      const ParameterEstimate &i = a.parameters[k], &j = b.parameters[k];
      EXPECT_LT(std::abs(i.value - j.value), 0.25 * j.sigma)
          << TermLibrary::specs[i.param].key.view();
      EXPECT_NEAR(i.sigma / j.sigma, 1.0, 0.05) << TermLibrary::specs[i.param].key.view();
    }
  }
}

TEST(IteratedPasses, StartsAnewWithoutATrace) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1200.0, 120.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Simulation a = Simulator(base_truth(Coupling::eq5), Readout{}).run(timeline, 4, 2);
  const Simulation b = Simulator(base_truth(Coupling::eq5), Readout{}).run(timeline, 4, 3);
  const Theta start = make_layout(filter).theta;
  IteratedPasses one(filter, timeline, Readout{}, start), other(filter, timeline, Readout{}, start);
  const FilterEstimate& fresh = one.run(a.measured, start);
  other.run(b.measured, draw_parameters(filter, 1, 1, Purpose::test));
  const FilterEstimate& again = other.run(a.measured, start);
  EXPECT_EQ(fresh.x(), again.x());
  EXPECT_EQ(fresh.nis(), again.nis());
  EXPECT_EQ(fresh.lag1(), again.lag1());
}

TEST(IteratedPasses, ReportsDivergenceAsAValueAndRecovers) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1200.0, 120.0);
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Simulation sim = Simulator(base_truth(Coupling::eq5), Readout{}).run(timeline, 4, 2);
  const Theta start = make_layout(filter).theta;
  Measurements absurd = sim.measured;
  absurd.acc.setConstant(1e9);
  IteratedPasses ekf(filter, timeline, Readout{}, start);
  const FilterEstimate& found = ekf.run(absurd, start);
  EXPECT_EQ(found.status(), EstimateStatus::diverged);
  EXPECT_FALSE(found.cause().empty());
  EXPECT_EQ(ekf.run(sim.measured, start).status(), EstimateStatus::ok);
}

TEST(Ekf, ResetIsAsBuiltAnew) {
  const Timeline timeline = preset_timeline("six", CommandLaw::free, 1200.0, 120.0);
  const FilterSpec filter = base_filter(Coupling::eq6);
  const Simulation sim = Simulator(base_truth(Coupling::eq6), Readout{}).run(timeline, 4, 2);
  const Theta start = draw_parameters(filter, 1, 1, Purpose::test);
  const EstimateResult fresh = run_ekf(filter, {timeline, Readout{}, sim.measured}, start);
  Ekf ekf(filter, timeline, Readout{}, make_layout(filter).theta, KeepHistory::no);
  for (int round = 0; round < 2; ++round) {
    ekf.reset(start);
    for (std::size_t i = 0; i < timeline.intervals.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      ekf.process(i, sim.measured.acc.col(column), sim.measured.gimbal.col(column));
    }
    const EstimateResult again = ekf.result();
    EXPECT_EQ(again.covariance, fresh.covariance);
    EXPECT_EQ(again.statistic, fresh.statistic);
    for (std::size_t k = 0; k < fresh.parameters.size(); ++k)
      EXPECT_EQ(again.parameters[k].value, fresh.parameters[k].value);
  }
  EXPECT_TRUE(ekf.history().t.empty());
}

}  // namespace
}  // namespace drift::iterated_passes_test
