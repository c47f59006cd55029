// Noise reaches the rows as a drift of the gyros does.
#include <gtest/gtest.h>

#include "analysis/inference/signatures.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::inference::noise_carried_test {
namespace {

using namespace drift::test;

TEST(NoiseCarried, ASteadyDriftOfEveryIntervalIsTheFixedDriftOverHoursWithoutCaging) {
  const Timeline timeline = preset_timeline("slew12", CommandLaw::level, 3600.0, 60.0);
  const Readout readout;
  const FilterSpec filter = base_filter(Coupling::eq5);
  const Measurements measured =
      Simulator(base_truth(Coupling::eq5), readout).run(timeline, 8, 0).measured;
  const MeasuredTest test{timeline, readout, measured};
  const LinearProblem p =
      linear_problem(filter, test, fit_batch(filter, test, make_layout(filter).theta), {});
  const Layout layout = make_layout(filter);
  for (std::size_t gyro = 0; gyro < 3; ++gyro) {
    const auto at = std::ranges::find(layout.params, TermLibrary::index("D_F_x") + gyro);
    ASSERT_NE(at, layout.params.end());
    const auto place = at - layout.params.begin();
    VecX carried = VecX::Zero(p.rows());
    Vec3 turned = Vec3::Zero();
    std::size_t done = 0;
    for (Eigen::Index k = 0; k < p.rows(); ++k) {
      const std::size_t end = p.tags[k].interval + (p.tags[k].accelerometer() ? 0 : 1);
      for (; done < end; ++done) {
        if (p.drives[done].cage) turned.setZero();
        turned += p.drives[done].per_rate.col(static_cast<Eigen::Index>(gyro));
      }
      carried[k] = p.psi.row(k).dot(turned) * layout.sigma[place];
    }
    // An accelerometer row is here a drift of half an interval behind: 1 in 700.
    const VecX column = p.theta.col(place);
    EXPECT_LT((carried - column).norm(), 0.01 * column.norm()) << gyro;
  }
}

}  // namespace
}  // namespace drift::inference::noise_carried_test
