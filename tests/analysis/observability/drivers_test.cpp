// What halving a noise or a prior does to sigmas, a second way: ranked again with the half.
#include "analysis/observability/drivers.hpp"

#include <gtest/gtest.h>

#include "analysis/planning/rank.hpp"
#include "analysis/report/rank/sections.hpp"
#include "tests/analysis/observability/ranking_fixture.hpp"

namespace drift::drivers_test {
namespace {

using namespace drift::test;
using namespace observability;

const TestPlan& plan() {
  static const TestPlan six = plan_of("six", CommandLaw::free, 1200.0);
  return six;
}

RankedModel model() {
  return model_of(Coupling::eq5,
                  {"D_F_x", "D_F_y", "D_I_x", "D_S_x", "eta_x", "xi_x", "K1_x", "K3_x"});
}

VecX sigmas_of(const RankedModel& m) {
  const Ranking r = rank_parameters(linearise(plan(), m));
  VecX all(static_cast<Eigen::Index>(r.parameters.size()));
  for (std::size_t k = 0; k < r.parameters.size(); ++k)
    all[static_cast<Eigen::Index>(k)] = r.parameters[k].posterior_sigma;
  return all;
}

TEST(Drivers, OfPriorsAndNoiseAreThoseOfAPlanRankedWithTheHalf) {
  const RankedModel m = model();
  const LinearisedPlan linearised = linearise(plan(), m);
  const Drivers d = drivers_of(linearised, plan(), m);
  const VecX before = sigmas_of(m);
  for (Eigen::Index j = 0; j < before.size(); ++j) {
    RankedModel better = m;
    const std::size_t p = linearised.layout.params[static_cast<std::size_t>(j)];
    better.spec.priors[p] = normal(m.spec.priors[p].mean(), 0.5 * m.spec.priors[p].sigma());
    const VecX ratio = sigmas_of(better).cwiseQuotient(before);
    for (Eigen::Index k = 0; k < before.size(); ++k)
      EXPECT_NEAR(d.priors(k, j), ratio[k], 1e-6) << k << " " << j;
  }
  RankedModel attitude = m;
  attitude.spec.initial_attitude *= 0.5;
  EXPECT_LT((d.attitude - sigmas_of(attitude).cwiseQuotient(before)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_TRUE((d.accelerometers.array() <= 1.0 + 1e-12).all());
  EXPECT_TRUE((d.gimbals.array() < 1.0).any());
  EXPECT_TRUE((d.process_noise.array() == 1.0).all()) << "there is none";
}

TEST(Drivers, TogetherHalveEverySigma) {
  // Sigmas are proportional to all noise and priors together: for small changes the parts of the
  // variance that each is behind add up to one. Of priors these are P_kj^2 / P_kk.
  const RankedModel m = model();
  RankedModel half = m;
  half.readout.accelerometer_noise *= 0.5;
  half.readout.gimbal_noise *= 0.5;
  half.spec.initial_attitude *= 0.5;
  for (const std::size_t p : linearise(plan(), m).layout.params)
    half.spec.priors[p] = normal(m.spec.priors[p].mean(), 0.5 * m.spec.priors[p].sigma());
  const VecX ratio = sigmas_of(half).cwiseQuotient(sigmas_of(m));
  for (const double r : ratio) EXPECT_NEAR(r, 0.5, 1e-9);
}

TEST(Drivers, OfProcessNoiseAreThoseOfItsTermsToo) {
  RankedModel walking = model();
  walking.spec.active |= params_named("drift_random_walk");
  for (const char* key : {"q_x", "q_y", "q_z"})
    walking.spec.priors[param(key)] = fixed(0.1 * deg_per_h / 60.0);
  walking = ranked_model(walking.spec, nullptr, walking.site, walking.readout);
  RankedModel half = walking;
  for (const char* key : {"q_x", "q_y", "q_z"})
    half.spec.priors[param(key)] = fixed(0.05 * deg_per_h / 60.0);
  half = ranked_model(half.spec, nullptr, half.site, half.readout);
  const Drivers d = drivers_of(linearise(plan(), walking), plan(), walking);
  const VecX ratio = sigmas_of(half).cwiseQuotient(sigmas_of(walking));
  EXPECT_LT((d.process_noise - ratio).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(ratio.minCoeff(), 0.9);
}

TEST(Drivers, TableSaysTheStrongestOtherPrior) {
  planning::ModelRanking m;
  m.model = model();
  const LinearisedPlan linearised = linearise(plan(), m.model);
  m.ranking = rank_parameters(linearised);
  m.drivers = drivers_of(linearised, plan(), m.model);
  const report::Table table = report::driver_table(m);
  int driven = 0;
  for (std::size_t row = 0; row < m.ranking.order.size(); ++row) {
    const std::size_t k = m.ranking.order[row];
    double most = 0.001;  // less is not worth a name
    std::string other = "-";
    for (std::size_t j = 0; j < m.ranking.order.size(); ++j) {
      const double part =
          1.0 - m.drivers.priors(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j));
      if (j == k || part < most) continue;
      most = part;
      other = report::parameter_key(m.ranking.layout, j);
    }
    EXPECT_EQ(table.rows[row].cells[0].text, report::parameter_key(m.ranking.layout, k));
    EXPECT_EQ(table.rows[row].cells[5].text, other);
    driven += other == "-" ? 0 : 1;
  }
  EXPECT_GT(driven, 0);  // K1 and K3 of one accelerometer are hard to tell apart
}

}  // namespace
}  // namespace drift::drivers_test
