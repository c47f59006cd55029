#include <gtest/gtest.h>

#include "core/estimate/batch.hpp"
#include "tests/support/case_unit.hpp"

namespace drift::strapdown::lever_arm_test {

using namespace case_unit;

/// Of 8 units whose accelerometers sit centimetres apart and lag by a millisecond: errors of both
/// in their own sigmas. 80 of them would have an rms of 1 +- 0.08.
TEST(CaseTest, LeverArmsAndDelayAreFoundWhereTurnsAreRead) {
  Theta theta = sensors();
  std::vector<std::size_t> wanted;
  constexpr std::pair<const char*, double> places[] = {
      {"arm_x_x", 1.0},  {"arm_y_x", -2.0}, {"arm_z_x", 3.0}, {"arm_x_y", 4.0}, {"arm_y_y", 5.0},
      {"arm_z_y", -6.0}, {"arm_x_z", 0.0},  {"arm_y_z", 2.0}, {"arm_z_z", 1.0}, {"acc_delay", 1.0}};
  for (const auto& [key, value] : places) {
    set(theta, key, value);
    wanted.push_back(*TermLibrary::find(key));
  }
  double squares = 0.0, chi2 = 0.0, measured = 0.0;
  for (std::uint64_t seed = 201; seed <= 208; ++seed) {
    const Unit u = unit_of(script(seed), theta, InTurns::read);
    ASSERT_TRUE(u.test.timeline.reads_turns);
    FilterSpec filter = filter_for(u.test, std::max(10.0 * u.compass.sigma, 2e-3));
    for (const std::size_t p : wanted) {
      filter.active.set(p);
      filter.priors[p] = TermLibrary::specs[p].prior_si();
    }
    const BatchResult fit = fit_batch(filter, {u.test.timeline, u.test.readout, u.test.measured},
                                      make_layout(filter).theta);
    ASSERT_EQ(fit.estimate.status, EstimateStatus::ok);
    chi2 += fit.estimate.statistic;
    measured += static_cast<double>(fit.estimate.measured);
    for (const std::size_t p : wanted) {
      const ParameterEstimate& found = *fit.estimate.find(p);
      const double z = (found.value - theta[static_cast<Eigen::Index>(p)]) / found.sigma;
      EXPECT_LT(std::abs(z), 4.5) << TermLibrary::specs[p].key.view() << ", seed " << seed;
      EXPECT_LT(found.learning_ratio(), 0.05) << TermLibrary::specs[p].key.view();
      squares += z * z;
    }
  }
  EXPECT_GT(std::sqrt(squares / 80.0), 0.8);
  EXPECT_LT(std::sqrt(squares / 80.0), 1.25);
  EXPECT_NEAR(chi2 / measured, 1.0, 0.05);
}

}  // namespace drift::strapdown::lever_arm_test
