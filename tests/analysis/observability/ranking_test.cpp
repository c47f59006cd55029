#include "analysis/observability/ranking.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/observability/against_monte_carlo.hpp"
#include "analysis/observability/information_by_position.hpp"
#include "analysis/observability/other_methods.hpp"
#include "analysis/report/page/degeneracies.hpp"
#include "core/base/check.hpp"
#include "core/estimate/triangle.hpp"
#include "tests/analysis/observability/ranking_fixture.hpp"

namespace drift::ranking_test {
namespace {

using namespace drift::test;

constexpr auto everything = [](const observability::TimeBin&) { return true; };

/// Posterior covariance of [psi of each chain | x] by normal equations, its x block.
MatX textbook_covariance(const observability::LinearisedPlan& plan, int without = -1) {
  const Eigen::Index n = plan.size(), m = 3 * plan.chains;
  MatX I = MatX::Identity(m + n, m + n);
  for (const observability::TimeBin& bin : plan.bins) {
    if (bin.position == without) continue;
    MatX J = MatX::Zero(bin.rows.rows(), m + n);
    J.middleCols(3 * bin.chain, 3) = bin.rows.leftCols(3);
    J.rightCols(n) = bin.rows.rightCols(n);
    I += J.transpose() * J;
  }
  return I.inverse().bottomRightCorner(n, n);
}

TEST(Ranking, SmallProblemInClosedForm) {
  const observability::LinearisedPlan plan = small_plan();
  const MatX P = textbook_covariance(plan), I = P.inverse();
  const observability::Ranking r = observability::rank_parameters(plan);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(r.learning_ratio(k), std::sqrt(P(k, k)), 1e-13);
    EXPECT_NEAR(r.parameters[k].posterior_sigma, 2.0 * std::sqrt(P(k, k)), 1e-13);
    EXPECT_NEAR(r.parameters[k].conditional_sigma, 2.0 / std::sqrt(I(k, k)), 1e-13);
    EXPECT_NEAR(r.parameters[k].bits(), -0.5 * std::log2(P(k, k)), 1e-12);
    EXPECT_GE(r.parameters[k].collinearity(), 1.0);
  }
  EXPECT_NEAR(r.bits, -0.5 * std::log2(P.determinant()), 1e-12);
  double product = 0.0;  // bits are also those of the eigenvalues
  for (const observability::EigenDirection& d : r.spectrum)
    product += 0.5 * std::log2(1.0 + d.information);
  EXPECT_NEAR(r.bits, product, 1e-12);
  EXPECT_TRUE(std::ranges::is_sorted(r.spectrum, std::greater{},
                                     &observability::EigenDirection::information));
  EXPECT_TRUE(
      std::ranges::is_sorted(r.order, {}, [&](std::size_t k) { return r.learning_ratio(k); }));
}

TEST(Ranking, GainsAddUpAndLossesAreThoseOfAPlanWithoutThePosition) {
  const observability::LinearisedPlan plan = small_plan();
  const observability::Ranking r = observability::rank_parameters(plan);
  const observability::InformationCourse course = observability::information_course(plan);
  EXPECT_NEAR(course.bits.sum(), r.bits, 1e-12);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(course.gain.row(k).sum(), r.parameters[k].bits(), 1e-12);
    EXPECT_NEAR(course.position_gain.row(k).sum(), r.parameters[k].bits(), 1e-12);
    for (int p = 0; p < 3; ++p)
      EXPECT_NEAR(course.loss(k, p),
                  0.5 * std::log2(textbook_covariance(plan, p)(k, k)) + r.parameters[k].bits(),
                  1e-12);
  }
}

TEST(Ranking, InformationOfCagedPositionsAdds) {
  const TestPlan plan = plan_of("six", CommandLaw::free);
  const observability::RankedModel model = model_of(Coupling::eq5);
  const MatX all = information_root(observability::linearise(plan, model), everything);
  MatX sum = MatX::Zero(all.rows(), all.cols());
  for (const Position& p : plan.positions) {
    TestPlan one = plan;
    one.positions = {p};
    const MatX R = information_root(observability::linearise(one, model), everything);
    sum += R.transpose() * R;
  }
  EXPECT_LT((all.transpose() * all - sum).norm(), 1e-12 * sum.norm());
}

TEST(Ranking, TimeBinsHoldTheInformationOfTheWhole) {
  const observability::RankedModel model = model_of(Coupling::eq6);
  const TestPlan plan = plan_of("slew12", CommandLaw::level, 600.0);
  const observability::LinearisedPlan coarse = observability::linearise(plan, model, 1),
                                      fine = observability::linearise(plan, model, 5);
  ASSERT_EQ(coarse.bins.size(), 12u + 11u);  // dwells and slews
  ASSERT_EQ(fine.bins.size(), 5u * 12u + 11u);
  for (std::size_t b = 1; b < fine.bins.size(); ++b)
    EXPECT_EQ(fine.bins[b].t0, fine.bins[b - 1].t1);
  const MatX a = information_root(coarse, everything), b = information_root(fine, everything);
  EXPECT_LT((a.transpose() * a - b.transpose() * b).norm(), 1e-12 * (a.transpose() * a).norm());
}

struct TableRow {
  const char* preset;
  int acc, acc_enc;  ///< rank of 63, physics.md 2.5 (twelve: see pwcs_test.cpp)
};
constexpr TableRow table[] = {
    {"six", 34, 36}, {"apollo10", 51, 52}, {"twelve", 45, 45}, {"twentyfour", 45, 45}};

TEST(Ranking, RanksOfTheTableFromTheInformation) {
  // The table knows the rotations between positions: one attitude error for all, in local axes. So
  // the rows of all positions stand under the same three columns here, without any prior.
  for (const TableRow& row : table)
    for (const bool gimbals : {false, true}) {
      observability::RankedModel model = model_of(Coupling::eq5);
      model.readout.gimbals = gimbals;
      const observability::LinearisedPlan plan =
          observability::linearise(plan_of(row.preset, CommandLaw::level, 3600.0, 300.0), model);
      MatX R = MatX::Zero(63, 63);
      for (const observability::TimeBin& bin : plan.bins) R = triangle(stacked(R, bin.rows));
      const auto spectrum = observability::spectrum_of(R);
      const int rank = gimbals ? row.acc_enc : row.acc;
      // The last that counts and the first that does not are decades apart.
      EXPECT_GT(spectrum[rank - 1].information, 1e-6) << row.preset << gimbals;
      EXPECT_LT(spectrum[rank].information, 1e-15) << row.preset << gimbals;
    }
}

TEST(Ranking, WithGimbalsACagingCostsNoRank) {
  // Gimbals have no parameters of their own: they tell the attitude after every caging. What is
  // left of the table's rank is that of the parameters, 3 less.
  for (const Coupling coupling : {Coupling::eq5, Coupling::eq6})
    for (const TableRow& row : table) {
      const TestPlan plan = plan_of(row.preset, CommandLaw::level, 3600.0, 300.0);
      const observability::Ranking r =
          observability::rank_parameters(observability::linearise(plan, model_of(coupling)));
      EXPECT_EQ(r.layout.size() - r.unseen.size(), row.acc_enc - 3u) << row.preset;
      EXPECT_EQ(exactly_unseen(r.unseen, r.root), r.unseen.size()) << row.preset;
      EXPECT_EQ(r.unheld.size(), r.unseen.size()) << row.preset;
    }
}

std::vector<std::string> combinations(const observability::Ranking& r,
                                      const std::vector<WeakDirection>& directions) {
  std::vector<std::string> all;
  for (const auto& d :
       report::name_degeneracies(r.layout, Mounting{}, {directions, r.root, r.excitation}))
    all.push_back(d.combination);
  return all;
}

TEST(Ranking, ExactDegeneraciesAreFoundByName) {
  const observability::Ranking r = observability::rank_parameters(observability::linearise(
      plan_of("twentyfour", CommandLaw::level, 3600.0, 300.0), model_of(Coupling::eq5)));
  const auto names = combinations(r, r.unseen);
  ASSERT_EQ(names.size(), 18u);  // physics.md 2.4
  for (const char axis : {'x', 'y', 'z'}) {
    const auto has = [&](std::string text) {
      for (auto at = text.find('#'); at != std::string::npos; at = text.find('#')) text[at] = axis;
      return std::ranges::find(names, text) != names.end();
    };
    EXPECT_TRUE(has("D_F_# - D_II_# - D_OO_# - D_SS_#"));
    EXPECT_TRUE(has("K1_# - K3_#"));
    for (const char* alone : {"D_IO_#", "D_IS_#", "D_OS_#", "K_ip_#"}) EXPECT_TRUE(has(alone));
  }
  // Floor of D_F by the priors of the three it cannot be told from: 0.1/sqrt(3) against a prior
  // of 1.
  const double floor = 0.1 / std::sqrt(3.0), left = floor / std::sqrt(1.0 + floor * floor);
  for (const auto& p : r.parameters)
    if (TermLibrary::specs[p.param].group == Name("D_F")) {
      EXPECT_NEAR(p.learning_ratio(), left, 1e-5);
    }
}

TEST(Ranking, GaugeIsHeldByTheAttitudePriorAloneWithoutGimbals) {
  // physics.md 2.4: a common rotation of both triads and the attitude, 3 directions; they are exact
  // with accelerometers only, gyros on the platform (eq. 6) and slews by gyro commands.
  observability::RankedModel model = model_of(Coupling::eq6, {"eta", "xi", "dP", "dO"});
  model.readout.gimbals = false;
  const observability::Ranking r = observability::rank_parameters(
      observability::linearise(plan_of("slew12", CommandLaw::level, 1200.0), model));
  EXPECT_EQ(r.unseen.size(), 0u);
  ASSERT_EQ(r.unheld.size(), 3u);
  const auto named = report::name_degeneracies(r.layout, Mounting{},
                                               {r.unheld, r.root_unheld, r.excitation}, r.unseen);
  ASSERT_EQ(named.size(), 3u);
  for (const auto& d : named) EXPECT_TRUE(d.reason.starts_with("gauge")) << d.combination;
  // The limit by priors: 1/sqrt(2/200^2 + 2/100^2 + 1/200^2) = 60.3 arcsec; data cannot beat it.
  const double limit = 1.0 / std::sqrt(3.0 / (200.0 * 200.0) + 2.0 / (100.0 * 100.0)) * arcsec;
  for (const auto& p : r.parameters)
    if (TermLibrary::specs[p.param].group == Name("eta")) {
      EXPECT_NEAR(p.posterior_sigma / limit, 1.0, 0.01);
    }
}

TEST(Ranking, LearningRatioIsThatOfABatchFitAtTheTruth) {
  const TestPlan plan = plan_of("slew12", CommandLaw::free, 600.0);
  FilterSpec filter = base_filter(Coupling::eq6);
  filter.active = only({"D_F", "D_I", "D_S", "eta", "xi", "s", "K0"});
  TruthSpec truth = base_truth(Coupling::eq6);
  truth.active = filter.active;
  const Theta nominal = random_theta(11);
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i) truth.priors[i] = fixed(nominal[i]);
  const observability::RankedModel model =
      observability::ranked_model(filter, &truth, harbin, Readout{});
  const observability::Ranking r =
      observability::rank_parameters(observability::linearise(plan, model));

  // Data without noise or attitude error, a fit held at the truth: one solution of the same
  // problem.
  const Timeline timeline = lay_out(plan, harbin);
  Readout silent;
  silent.accelerometer_noise = silent.gimbal_noise = 0.0;
  const TruthDraw draw{model.nominal, std::vector<Vec3>(timeline.chains, Vec3::Zero())};
  const Simulation sim = Simulator(truth, silent).run(timeline, draw, 1, 0);
  for (const std::size_t i : make_layout(filter).params) filter.priors[i].a = model.nominal[i];
  const BatchResult fit = fit_batch(filter, {timeline, Readout{}, sim.measured}, model.nominal);
  ASSERT_EQ(fit.estimate.status, EstimateStatus::ok) << fit.estimate.cause;
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    EXPECT_NEAR(fit.estimate.parameters[k].learning_ratio() / r.learning_ratio(k), 1.0, 1e-6)
        << TermLibrary::specs[r.parameters[k].param].key.view();
}

TEST(Ranking, PromisedSigmasAreTheErrorsOfBatchFits) {
  // Matched and nearly linear: 60 draws of truth, attitude and noise, each fitted by batch.
  const TestPlan plan = plan_of("six", CommandLaw::level, 600.0, 120.0);
  FilterSpec filter = base_filter(Coupling::eq5);
  filter.active = only({"D_F", "D_I", "eta", "K0", "dP"});
  TruthSpec truth;
  static_cast<ModelSpec&>(truth) = filter;
  const Timeline timeline = lay_out(plan, harbin);
  const observability::Ranking r = observability::rank_parameters(observability::linearise(
      plan, observability::ranked_model(filter, nullptr, harbin, Readout{})));
  constexpr int runs = 60;
  VecX square = VecX::Zero(static_cast<Eigen::Index>(r.parameters.size()));
  Simulator simulator(truth, Readout{});
  for (int run = 0; run < runs; ++run) {
    const Simulation sim = simulator.run(timeline, 5, run);
    ASSERT_TRUE(sim.ode.ok());
    const BatchResult fit =
        fit_batch(filter, {timeline, Readout{}, sim.measured}, make_layout(filter).theta);
    for (std::size_t k = 0; k < r.parameters.size(); ++k)
      square[k] +=
          std::pow(fit.estimate.parameters[k].value - sim.draw.theta[r.parameters[k].param], 2);
  }
  // (RMSE/sigma)^2 is chi-square of 60 over 60: deviation of the ratio 1/sqrt(120) = 0.091 per
  // parameter; 4 sigma for the worst of 15 (chance 1e-3). Mean of the 15: two of them may be one
  // (correlated), so no tighter than 3 sigma of about 5 independent ones.
  double mean = 0.0;
  std::vector<observability::MonteCarloError> errors;
  for (std::size_t k = 0; k < r.parameters.size(); ++k) {
    const double rmse = std::sqrt(square[k] / runs), ratio = rmse / r.parameters[k].posterior_sigma;
    EXPECT_NEAR(ratio, 1.0, 4.0 * 0.091) << TermLibrary::specs[r.parameters[k].param].key.view();
    mean += ratio * ratio / static_cast<double>(r.parameters.size());
    errors.push_back({r.parameters[k].param, rmse, rmse * (1.0 - 2.0 * 0.091),
                      rmse * (1.0 + 2.0 * 0.091), r.parameters[k].posterior_sigma});
  }
  EXPECT_NEAR(mean, 1.0, 3.0 * std::sqrt(2.0 / runs / 5.0));
  const auto comparison =
      observability::compare_with_monte_carlo(r, errors, observability::TruthIs::the_model);
  ASSERT_EQ(comparison.parameters.size(), r.parameters.size());
  EXPECT_EQ(comparison.count(observability::ErrorVerdict::wrong_model), 0u);
  EXPECT_LE(comparison.count(observability::ErrorVerdict::nonlinear), 1u);
  EXPECT_GT(comparison.spearman, 0.8);
}

TEST(Ranking, AModelThatSeesTheFieldIsRankedInTheFieldOfTheStudy) {
  ModelSpec spec = base_spec(Coupling::eq5);
  for (const char* key : {"M_x", "M_y", "M_z"}) {
    const std::size_t i = *TermLibrary::find(key);
    spec.active.set(i);
    spec.priors[i] = TermLibrary::specs[i].prior_si();
  }
  const TestPlan plan = plan_of("six", CommandLaw::free, 600.0);
  EXPECT_THROW(
      observability::linearise(plan, observability::ranked_model(spec, nullptr, harbin, Readout{})),
      InputError);
  Environment field;
  field[covariate("field")].mean = {0.25e-4, 0.0, -0.47e-4};
  const observability::Ranking r = observability::rank_parameters(observability::linearise(
      plan, observability::ranked_model(spec, nullptr, harbin, Readout{}, field)));
  EXPECT_FALSE(r.parameters.empty());
}

}  // namespace
}  // namespace drift::ranking_test
