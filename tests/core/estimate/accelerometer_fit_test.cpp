#include "core/estimate/strapdown/accelerometer_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::accelerometer_fit_test {
namespace {

Theta sensors() {
  Theta theta = Theta::Zero();
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, double>>{{"K0_x", 9000},
                                                             {"K0_y", -14000},
                                                             {"K0_z", 4000},
                                                             {"K1_x", 12000},
                                                             {"K1_y", -7000},
                                                             {"K1_z", 3000},
                                                             {"dO_y", 1500},
                                                             {"dP_z", -2000},
                                                             {"dO_z", 800}})
    test::set(theta, key, value);
  return theta;
}

std::vector<Vec3> outputs(const Theta& theta, int count, double noise, std::uint64_t seed) {
  Stream stream(seed, 0, Purpose::test);
  const auto draw = [&] { return Vec3{stream.normal(), stream.normal(), stream.normal()}; };
  std::vector<Vec3> all;
  for (int k = 0; k < count; ++k) {
    const Vec3 up = draw().normalized();
    all.push_back(test::accelerometer_output(theta, up) + noise * draw());
  }
  return all;
}

TEST(AccelerometerFit, WithoutNoiseTheSensorsAreFound) {
  const Theta truth = sensors();
  const Estimate fit =
      fit_accelerometers(AccelerometerModel::misaligned, outputs(truth, 30, 0.0, 1));
  EXPECT_TRUE(fit.converged);
  for (const std::size_t p : fit.params)
    EXPECT_NEAR(fit.theta[p], truth[p], 1e-9) << TermLibrary::specs[p].key.view();
}

TEST(AccelerometerFit, SigmaIsTheScatterOverManyTests) {
  const Theta truth = sensors();
  double squares = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Estimate fit =
        fit_accelerometers(AccelerometerModel::misaligned, outputs(truth, 30, 1e-4, seed));
    for (std::size_t k = 0; k < fit.params.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const std::size_t p = fit.params[k];
      squares += std::pow(fit.theta[p] - truth[p], 2) / fit.covariance(row, row);
      count += 1.0;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.15);
}

TEST(AccelerometerFit, SpecificForceIsWhatTheOutputWasMadeFrom) {
  Theta theta = sensors();
  test::set(theta, "K2_x", 3000.0);
  test::set(theta, "K2_z", -2000.0);
  const SpecificForce force(theta);
  for (const Vec3& f : {Vec3(0.0, 0.0, 1.0), Vec3(0.6, -0.8, 0.0), Vec3(-0.5, 0.5, 0.7)})
    EXPECT_LT((force(test::accelerometer_output(theta, f)) - f).norm(), 1e-12);
}

}  // namespace
}  // namespace drift::strapdown::accelerometer_fit_test
