// Misalignments of unknown size, against closed forms.
#include "analysis/inference/misalignments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/physics/closure.hpp"
#include "tests/support/model_builders.hpp"
#include "tests/support/white_problem.hpp"

namespace drift::inference::misalignments_test {
namespace {

/// The gain where six misalignments are seen with this information each, in prior sigmas, and are
/// found to be zero, beside drifts that are all known to a tenth of their prior.
double gain_at_zero(double information) {
  FilterSpec filter = test::base_filter(Coupling::eq5);
  filter.active = test::only({"D_F", "eta", "xi"});
  const Layout layout = make_layout(filter);
  const auto n = static_cast<Eigen::Index>(layout.size());
  VecX seen(n);
  for (Eigen::Index k = 0; k < n; ++k)
    seen[k] =
        is_misalignment(layout.params[static_cast<std::size_t>(k)]) ? std::sqrt(information) : 10.0;
  const LinearProblem problem =
      test::white_problem(seen.asDiagonal().toDenseMatrix(), MatX(n, 0), VecX::Zero(n));
  return log_gain_of_misalignments(layout, Projector(problem, {}));
}

TEST(Misalignments, AreThoseOfGyros) {
  EXPECT_TRUE(is_misalignment(test::param("eta_x")));
  EXPECT_TRUE(is_misalignment(test::param("xi_z")));
  EXPECT_FALSE(is_misalignment(test::param("D_F_x")));
  EXPECT_FALSE(is_misalignment(test::param("dP_y")));
}

TEST(Misalignments, ThatATestDoesNotShowChangeNoEvidence) {
  EXPECT_NEAR(gain_at_zero(0.0), 0.0, 1e-12);
}

TEST(Misalignments, ThatAreSmallAreNoCoincidence) {
  // Each scale s has a density at zero that is 1 / s times as large, six times over, as long as the
  // test sees it: the mean over them. What is seen is known to 1e-6 prior sigmas, and the scales
  // end with the first below a third of that.
  double mean = 0.0;
  std::vector<double> scales{1.0, 0.3};
  while (scales.back() > 1e-6 / 3.0) scales.push_back(scales[scales.size() - 2] / 10.0);
  EXPECT_EQ(scales.size(), 14u);
  for (const double s : scales)
    mean += std::pow(1.0 + s * s * 1e12, -3.0) * 1e36 / static_cast<double>(scales.size());
  EXPECT_NEAR(gain_at_zero(1e12), std::log(mean), 1e-6);
}

TEST(Misalignments, BesideAFreeLambdaAreThoseAtItsValue) {
  // What a test shows of lambda and of a common factor of the misalignments is one direction.
  FilterSpec filter = test::base_filter(Coupling::lambda);
  filter.active = test::only({"eta", "xi", "lambda"});
  const Layout layout = make_layout(filter);
  const auto n = static_cast<Eigen::Index>(layout.size());
  const Eigen::Index lambda =
      std::ranges::find(layout.params, closure_param) - layout.params.begin();
  const VecX found = VecX::LinSpaced(n, 0.5, 1.5);
  MatX J = 1e3 * MatX::Identity(n, n);
  J.col(lambda) = -1e3 * found;
  J(lambda, lambda) = 0.0;
  const auto rows = [&](const MatX& of, const VecX& r0) {
    return Projector(test::white_problem(of, MatX(n, 0), r0), {});
  };
  const VecX r0 = J * found;
  const Projector free = rows(J, r0);
  const double value = free.fit().x[lambda];
  MatX held = J;
  held.col(lambda).setZero();
  EXPECT_NEAR(log_gain_of_misalignments(layout, free),
              log_gain_of_misalignments(layout, rows(held, r0 - value * J.col(lambda))), 1e-6);
}

}  // namespace
}  // namespace drift::inference::misalignments_test
