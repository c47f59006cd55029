#include <gtest/gtest.h>

#include "core/base/normal_draws.hpp"
#include "core/estimate/batch.hpp"
#include "core/estimate/batch_problem.hpp"
#include "core/sim/predict.hpp"
#include "core/sim/simulate.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::compressed_test_test {
namespace {

struct Case {
  const char* plan;
  Coupling truth, filter;
  double sample;
  double dwell = 3600.0, slew_rate = 0.5 * drift::detail::deg;
};

void PrintTo(const Case& c, std::ostream* os) {
  *os << c.plan << ", " << facts(c.truth).name << " by " << facts(c.filter).name << ", " << c.sample
      << " s of " << c.dwell << ", slewed at " << c.slew_rate / drift::detail::deg << " deg/s";
}

class Compressed : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& c = GetParam();
    PlanDefaults defaults;
    defaults.dwell = c.dwell;
    defaults.sample = c.sample;
    TestPlan plan = preset_plan(c.plan, defaults).value();
    plan.slew_rate = c.slew_rate;
    timeline = lay_out(plan, test::harbin);
    const TruthSpec truth = test::base_truth(c.truth);
    filter = test::base_filter(c.filter);
    const TruthDraw draw = draw_truth(truth, timeline.chains, 1, 0);
    measured = Simulator(truth, readout).run(timeline, draw, 1, 0).measured;
    psi.assign(static_cast<std::size_t>(timeline.chains), Vec3(0.2, -0.4, 0.3));
  }
  Readout readout;
  Timeline timeline;
  FilterSpec filter;
  Measurements measured;
  std::vector<Vec3> psi;
};

TEST_P(Compressed, SaysWhatAllSamplesSay) {
  const MeasuredTest test{timeline, readout, measured};
  BatchProblem compressed(filter, test), all(filter, test);
  all.take_every_sample();
  ASSERT_TRUE(compressed.compressed());
  const VecX x = compressed.layout().scaled(make_layout(filter).theta) +
                 VecX::LinSpaced(static_cast<Eigen::Index>(compressed.layout().size()), -1.0, 1.0);
  const Evaluation few = compressed.evaluate(x, psi), many = all.evaluate(x, psi);
  EXPECT_TRUE(compressed.compressed());
  EXPECT_NEAR(few.cost / many.cost, 1.0, 1e-8);
  for (std::size_t c = 0; c < few.rows.size(); ++c) {
    EXPECT_LT(2 * few.rows[c].rows.rows(), many.rows[c].rows.rows() + 20);
    const MatX A = few.rows[c].rows.transpose() * few.rows[c].rows,
               B = many.rows[c].rows.transpose() * many.rows[c].rows;
    // As much as a sigma or an estimate can change by: against the information with the prior. The
    // samples' own quadrature is of the third order at the middle of an interval: 2e-7 at 180 s.
    for (Eigen::Index i = 0; i < A.rows() - 1; ++i)
      for (Eigen::Index j = 0; j < A.rows() - 1; ++j)
        EXPECT_NEAR(A(i, j), B(i, j), 5e-7 * std::sqrt((1.0 + B(i, i)) * (1.0 + B(j, j))));
  }
}

TEST_P(Compressed, AFitEndsWhereThatOfAllSamplesEnds) {
  const MeasuredTest test{timeline, readout, measured};
  const Theta start = make_layout(filter).theta;
  const BatchResult fit = fit_batch(filter, test, start);
  ASSERT_EQ(fit.estimate.status, EstimateStatus::ok);
  const BatchResult few = fit_batch_from(filter, test, theta_of(filter, fit), fit.psi0_l,
                                         {.result = BatchOptions::Result::estimates});
  EXPECT_EQ(few.acc_residual.cols(), 0);
  EXPECT_EQ(few.estimate.measured, fit.estimate.measured);
  // The samples' own quadrature, as above, adds up along a dwell of hours and a slow slew.
  const bool longer = GetParam().dwell > 3600.0 || GetParam().slew_rate < 0.1 * drift::detail::deg;
  EXPECT_NEAR(few.estimate.statistic / fit.estimate.statistic, 1.0, longer ? 5e-7 : 1e-8);
  for (std::size_t k = 0; k < fit.estimate.parameters.size(); ++k)
    EXPECT_NEAR(few.estimate.parameters[k].value, fit.estimate.parameters[k].value,
                1e-3 * fit.estimate.parameters[k].sigma);
}

INSTANTIATE_TEST_SUITE_P(, Compressed,
                         testing::Values(Case{"six", Coupling::eq5, Coupling::eq5, 180.0},
                                         Case{"six", Coupling::eq5, Coupling::eq6, 60.0},
                                         Case{"six", Coupling::eq6, Coupling::lambda, 10.0},
                                         Case{"twentyfour", Coupling::eq5, Coupling::eq6, 60.0},
                                         Case{"slew12", Coupling::eq6, Coupling::eq6, 60.0},
                                         Case{"casespin", Coupling::eq5, Coupling::lambda, 60.0},
                                         // The reference turns by more than an even number of steps
                                         // of 0.1 rad: more nodes than were first thought of.
                                         Case{"six", Coupling::eq5, Coupling::eq5, 60.0, 12600.0},
                                         Case{"six", Coupling::eq5, Coupling::eq6, 120.0, 14400.0},
                                         Case{"slew12", Coupling::eq5, Coupling::eq5, 60.0, 1800.0,
                                              0.05 * drift::detail::deg}));

/// Nodes are placed where the timeline wants them, whatever a stretch thought of: of every length.
TEST(CompressedTest, AStretchIsReadAtTheNodesItHas) {
  const Readout readout;
  for (double hours = 0.5; hours <= 12.0; hours += 0.5) {
    PlanDefaults defaults;
    defaults.dwell = 3600.0 * hours;
    defaults.sample = 60.0;
    const Timeline timeline = lay_out(preset_plan("six", defaults).value(), test::harbin);
    const CompressedTest test(timeline, readout, {});
    ASSERT_TRUE(test.any());
    for (std::size_t i = 0; i < test.timeline().intervals.size(); ++i) {
      if (test.readings(i) == nullptr) continue;
      const auto nodes = static_cast<Eigen::Index>(test.timeline().intervals[i].node_count());
      EXPECT_EQ(test.readings(i)->integral.cols(), nodes) << hours << " h";
      EXPECT_EQ(test.complete(i, Reading::mean).projection.of_nodes.cols(), nodes) << hours << " h";
    }
  }
}

/// Of every term that sees no covariates: those that follow the clock, gimbal angles or the past as
/// well as those that see attitude and command alone. Where no polynomials follow (a step within a
/// dwell) every sample is taken. Both end within the tolerance of a fit, 1e-4 of a sigma each.
TEST(CompressedTest, AFitOfEveryTermEndsWhereThatOfAllSamplesEnds) {
  const Readout readout;
  int taken_together = 0;
  for (const std::size_t t : test::visible_terms()) {
    const Timeline timeline = test::scene("six", CommandLaw::free, 3600.0);
    FilterSpec filter = test::base_filter(test::coupling_for(t));
    filter.active = test::only({"D_F", "eta"}) | test::term_params(t);
    if (!CompressedTest::can(filter.model())) continue;
    Theta theta = make_layout(filter).theta;
    test::set_term(theta, t);
    const std::vector<Vec3> level(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
    Measurements measured = predict(timeline, filter.model(), theta, level, readout);
    NormalDraws normal(1, t);
    for (double& v : measured.acc.reshaped()) v += readout.accelerometer_noise * normal();
    for (double& v : measured.gimbal.reshaped()) v += readout.gimbal_noise * normal();
    const MeasuredTest test{timeline, readout, measured};
    const BatchResult fit = fit_batch(filter, test, make_layout(filter).theta);
    ASSERT_EQ(fit.estimate.status, EstimateStatus::ok) << TermLibrary::terms[t].key;
    taken_together += BatchProblem(filter, test).compressed() ? 1 : 0;
    const BatchResult few = fit_batch_from(filter, test, theta_of(filter, fit), fit.psi0_l,
                                           {.result = BatchOptions::Result::estimates});
    for (std::size_t k = 0; k < fit.estimate.parameters.size(); ++k)
      EXPECT_NEAR(few.estimate.parameters[k].value, fit.estimate.parameters[k].value,
                  1e-3 * fit.estimate.parameters[k].sigma)
          << TermLibrary::terms[t].key;
  }
  EXPECT_GT(taken_together, 30);
}

/// A dead zone of the accelerometers ends within 500 ug: along a dwell a knee that no few
/// polynomials follow.
TEST(CompressedTest, WherePolynomialsAreTooFewEverySampleIsTaken) {
  PlanDefaults defaults;
  defaults.sample = 60.0;
  const Timeline timeline = lay_out(preset_plan("six", defaults).value(), test::harbin);
  TruthSpec truth = test::base_truth(Coupling::eq5);
  truth.active |= test::only({"Z", "Z_width"});
  FilterSpec filter = test::base_filter(Coupling::eq5);
  filter.active = truth.active;
  for (const std::size_t i : {test::param("Z_x"), test::param("Z_width")})
    filter.priors[i] = TermLibrary::specs[i].prior_si();
  const Readout readout;
  const TruthDraw draw = draw_truth(truth, timeline.chains, 1, 0);
  const Measurements measured = Simulator(truth, readout).run(timeline, draw, 1, 0).measured;
  BatchProblem problem(filter, {timeline, readout, measured});
  ASSERT_TRUE(problem.compressed());
  const VecX x = VecX::Zero(static_cast<Eigen::Index>(problem.layout().size()));
  const std::vector<Vec3> level(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
  const auto rows = [](const Evaluation& e) {
    Eigen::Index sum = 0;
    for (const ChainEquations& c : e.rows) sum += c.rows.rows();
    return sum;
  };
  const Evaluation few = problem.evaluate(x, level);
  problem.take_every_sample();
  const Evaluation many = problem.evaluate(x, level);
  EXPECT_NEAR(few.cost / many.cost, 1.0, 1e-8);
  EXPECT_GT(2 * rows(few), rows(many));
}

/// Where the gimbals turn back between two nodes that lie far apart, friction would not know.
TEST(CompressedTest, FrictionKeepsEverySample) {
  FilterSpec filter = test::base_filter(Coupling::eq5);
  EXPECT_TRUE(CompressedTest::can(filter.model()));
  filter.active |= test::only({"heat"});  // remembers the command
  EXPECT_TRUE(CompressedTest::can(filter.model()));
  filter.active |= test::only({"F"});
  EXPECT_FALSE(CompressedTest::can(filter.model()));
}

TEST(CompressedTest, RandomWalkIsNotWhiteAndKeepsEverySample) {
  FilterSpec filter = test::base_filter(Coupling::eq5);
  filter.noise.angle_random_walk = 1e-7;
  const Timeline timeline = test::preset_timeline("six", CommandLaw::free);
  const Readout readout;
  const Measurements measured{Mat3X::Zero(3, static_cast<Eigen::Index>(timeline.intervals.size())),
                              Mat3X::Zero(3, static_cast<Eigen::Index>(timeline.intervals.size()))};
  EXPECT_FALSE(BatchProblem(filter, {timeline, readout, measured}).compressed());
}

TEST(PolynomialProjection, OfAPolynomialIsExactWhereverItIsRead) {
  // Rows at uneven distances with uneven sigmas; degree 4 read through 6 polynomials at 9 nodes.
  const auto f = [](double u) { return 1.0 - 2.0 * u + 3.0 * u * u - u * u * u * u; };
  const auto integral = [](double u) { return u - u * u + u * u * u - std::pow(u, 5) / 5.0; };
  const MatX fit = legendre_fit(6, 9);
  VecX at_nodes(9), to_nodes(9);
  for (int k = 0; k < 9; ++k) {
    at_nodes[k] = f(0.25 * k - 1.0);
    to_nodes[k] = integral(0.25 * k - 1.0) - integral(-1.0);
  }
  EXPECT_LT((legendre_integral(fit) * at_nodes - to_nodes).norm(), 1e-13);
  std::vector<ReadingTime> times;
  for (double t = -1.0; t < 0.99; t = times.back().end)
    times.push_back({t, t + 0.05 + 0.02 * std::sin(9.0 * t), 0.5 + 0.2 * std::cos(5.0 * t)});
  for (const Reading what : {Reading::mean, Reading::at_end}) {
    const PolynomialProjection p = polynomial_projection(what, times, fit);
    VecX read(static_cast<Eigen::Index>(times.size())), sigma(read.size());
    for (Eigen::Index k = 0; k < read.size(); ++k) {
      const auto [begin, end, s] = times[static_cast<std::size_t>(k)];
      sigma[k] = s;
      read[k] = what == Reading::mean ? (integral(end) - integral(begin)) / (end - begin) : f(end);
    }
    EXPECT_LT((p.basis.transpose() * read.cwiseQuotient(sigma) - p.of_nodes * at_nodes).norm(),
              1e-12);
    EXPECT_LT((p.basis.transpose() * p.basis - MatX::Identity(6, 6)).norm(), 1e-13);
  }
}

}  // namespace
}  // namespace drift::compressed_test_test
