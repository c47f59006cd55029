// The skew of the resolvers is of the rates that the platform has, its own drift among them.
#include <gtest/gtest.h>

#include "core/sim/predict.hpp"
#include "tests/support/term_scenes.hpp"

namespace drift::timing_skew_test {
namespace {

using namespace drift::test;

Measurements predicted(const Timeline& timeline, double skew) {
  Theta theta = Theta::Zero();
  theta[param("D_F_x")] = 5.0 * deg_per_h;
  theta[param("skew")] = skew;
  const DriftModel model{Coupling::eq6, TermLibrary::terms_of(only({"D_F", "skew"})), {}};
  return predict(timeline, model, theta, std::vector<Vec3>(timeline.chains, Vec3::Zero()), {});
}

TEST(SkewOfADriftingPlatform, IsOfItsWholeRate) {
  // Beside the Earth's 15 deg/h a gyro drifts by 5: with the nominal rates alone the angles would
  // lag by up to a third less, and a fit would find the skew so much too large.
  const Timeline timeline = scene("six", CommandLaw::free);
  const Measurements without = predicted(timeline, 0.0), with = predicted(timeline, 3.0);
  for (Eigen::Index i = 1; i < 9; ++i)
    for (int k = 0; k < 3; ++k) {
      const double rate =
          angle_difference(without.gimbal(k, i + 1), without.gimbal(k, i - 1)) / 120.0;
      // Central difference over 2 x 60 s of angles that turn at 4/3 Omega: (4/3 Omega 60 s)^2 / 6 =
      // 6e-6 of the rate.
      EXPECT_NEAR(angle_difference(with.gimbal(k, i), without.gimbal(k, i)), 3.0 * rate,
                  1e-5 * 3.0 * 4.0 / 3.0 * detail::earth_rate);
    }
}

}  // namespace
}  // namespace drift::timing_skew_test
