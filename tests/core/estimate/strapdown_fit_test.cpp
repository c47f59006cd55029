#include <gtest/gtest.h>

#include "core/estimate/strapdown/rotation_fit.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::strapdown::strapdown_fit_test {
namespace {

using test::set;
using test::strapdown_recording;

/// Sensors of a small MEMS unit.
Theta sensors() {
  Theta theta = Theta::Zero();
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, double>>{
           {"D_F_x", 900},  {"D_F_y", -2500}, {"D_F_z", 1400},  {"D_I_x", 60},   {"D_I_y", -20},
           {"D_I_z", -40},  {"D_O_x", 300},   {"D_O_y", -250},  {"D_O_z", 180},  {"D_S_x", -220},
           {"D_S_y", 350},  {"D_S_z", 120},   {"s_x", 8000},    {"s_y", -5000},  {"s_z", 3000},
           {"eta_x", 2500}, {"eta_y", -1800}, {"eta_z", 900},   {"xi_x", -1200}, {"xi_y", 3000},
           {"xi_z", -2200}, {"K0_x", 9000},   {"K0_y", -14000}, {"K0_z", 4000},  {"K1_x", 12000},
           {"K1_y", -7000}, {"K1_z", 3000},   {"dO_y", 1500},   {"dP_z", -2000}, {"dO_z", 800}})
    set(theta, key, value);
  return theta;
}

std::vector<std::size_t> turning() {
  std::vector<std::size_t> all = group<"s">();
  for (const auto& g : {group<"eta">(), group<"xi">()}) all.insert(all.end(), g.begin(), g.end());
  return all;
}

struct Bench {
  std::vector<Dwell> dwells;
  std::vector<Rotation> rotations;
  Estimate accelerometer, drift;
  std::vector<Rotation> calibrated_turns;
};

Bench bench(const test::StrapdownScript& script, const Theta& theta) {
  Bench b;
  const Signals signals = signals_of(strapdown_recording(script, theta));
  b.dwells = find_dwells(signals, {}).dwells;
  b.rotations = find_rotations(signals, b.dwells).all;
  std::vector<Vec3> outputs;
  for (const Dwell& d : b.dwells) outputs.push_back(d.acc);
  b.accelerometer = fit_accelerometers(AccelerometerModel::misaligned, outputs);
  const SpecificForce force(b.accelerometer.theta);
  std::vector<Rest> rests;
  for (const Dwell& d : b.dwells) rests.push_back({d.gyro, force(d.acc)});
  b.drift = fit_drift(DriftOrder::g_sensitive, rests);
  for (const Rotation& turn : b.rotations)
    b.calibrated_turns.push_back(calibrated(turn, b.dwells, force));
  return b;
}

/// Errors of an estimate in its own standard deviations.
VecX normalised(const Estimate& estimate, const Theta& truth) {
  VecX z(static_cast<Eigen::Index>(estimate.params.size()));
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    const std::size_t p = estimate.params[static_cast<std::size_t>(i)];
    z[i] = (estimate.theta[p] - truth[p]) / std::sqrt(estimate.covariance(i, i));
  }
  return z;
}

TEST(StrapdownFit, KnownSensorsAreRecovered) {
  const Theta truth = sensors();
  const Bench b = bench({.dwells = 40, .seed = 5}, truth);
  const Estimate turned = fit_rotations(b.calibrated_turns, Coupling::eq5, b.drift, turning());
  ASSERT_TRUE(turned.converged);
  for (const Estimate* e : {&b.accelerometer, &b.drift, &turned}) {
    const VecX z = normalised(*e, truth);
    // Three sigma for each, or for the worst of n = 9..12 with a chance of 1 in 300: 3.6.
    EXPECT_LT(z.cwiseAbs().maxCoeff(), 3.6) << z.transpose();
    EXPECT_LT(z.squaredNorm() / static_cast<double>(z.size()), 2.5) << z.transpose();
  }
  // and the sigmas are worth something: far below what is to be found
  EXPECT_LT(std::sqrt(turned.covariance.diagonal().maxCoeff()), 1e-3);
}

TEST(StrapdownFit, SigmaIsTheScatterOverManyRecordings) {
  const Theta truth = sensors();
  double squares = 0.0;
  Eigen::Index count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Bench b = bench({.dwells = 20, .rest = 3.0, .seed = 100 + seed}, truth);
    const Estimate turned = fit_rotations(b.calibrated_turns, Coupling::eq5, b.drift, turning());
    const VecX z = normalised(turned, truth);
    squares += z.squaredNorm();
    count += z.size();
  }
  // 108 normalised errors, correlated within a recording: chi^2 / n is 1 within 0.4 or so.
  EXPECT_NEAR(squares / static_cast<double>(count), 1.0, 0.45);
}

TEST(StrapdownFit, WithoutNoiseTheTurnIsPredicted) {
  const Theta truth = sensors();
  const Bench b = bench({.dwells = 10, .gyro_noise = 0.0, .acc_noise = 0.0}, truth);
  ASSERT_EQ(b.rotations.size(), 9u);
  const SpecificForce force(truth);
  // The trapezoid of a smooth rate that starts and ends at zero: below 1e-5 rad at 100 Hz.
  for (const Rotation& turn : b.rotations)
    EXPECT_LT(prediction_error(calibrated(turn, b.dwells, force), Coupling::eq5, truth), 1e-5);
}

TEST(StrapdownFit, JacobianIsTheDerivative) {
  const Theta truth = sensors();
  const Bench b = bench({.dwells = 4, .gyro_noise = 0.0, .acc_noise = 0.0}, truth);
  std::vector<std::size_t> params;
  for (std::size_t p = 0; p < TermLibrary::index("K0_x"); ++p) params.push_back(p);
  for (const Rotation& turn : b.calibrated_turns) {
    const MatX J = predict(turn, Coupling::eq5, truth, params).jacobian;
    for (std::size_t p : params) {
      constexpr double h = 1e-5;
      Theta up = truth, down = truth;
      up[p] += h;
      down[p] -= h;
      const Vec3 slope =
          (predict(turn, Coupling::eq5, up, {}).up - predict(turn, Coupling::eq5, down, {}).up) /
          (2.0 * h);
      // Differences are good to h^2; the sum over steps takes the middle of each, good to 1e-3.
      EXPECT_LT((J.col(static_cast<Eigen::Index>(p)) - slope).norm(), 1e-3 * (slope.norm() + 0.1))
          << TermLibrary::specs[p].key.view();
    }
  }
}

TEST(StrapdownFit, EquationSixDoesNotKnowMisalignment) {
  const Theta truth = sensors();
  const Bench b = bench({.dwells = 20}, truth);
  Theta without = truth;
  for (const auto& g : {group<"eta">(), group<"xi">()})
    for (const std::size_t p : g) without[p] = 0.0;
  double five = 0.0;
  for (const Rotation& turn : b.calibrated_turns) {
    EXPECT_EQ(prediction_error(turn, Coupling::eq6, truth),
              prediction_error(turn, Coupling::eq6, without));
    five = std::max(five, prediction_error(turn, Coupling::eq5, without) -
                              prediction_error(turn, Coupling::eq5, truth));
  }
  EXPECT_GT(five, 0.005);  // [rad], of tilts up to 0.015 rad
  const Estimate six = fit_rotations(b.calibrated_turns, Coupling::eq6, b.drift, turning());
  for (std::size_t i = 3; i < 9; ++i) {
    EXPECT_EQ(six.theta[six.params[i]], 0.0);
    EXPECT_TRUE(
        std::isinf(six.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i))));
  }
}

TEST(StrapdownFit, TheIsotropicPartOfGSensitivityMovesNoGravity) {
  const Bench b = bench({.dwells = 20, .gyro_noise = 0.0, .acc_noise = 0.0}, Theta::Zero());
  for (const Rotation& turn : b.calibrated_turns) {
    const MatX J = predict(turn, Coupling::eq5, Theta::Zero(), group<"D_I">()).jacobian;
    const double common = J.rowwise().sum().norm(), single = J.colwise().norm().maxCoeff();
    EXPECT_LT(common, 1e-4 * single);
  }
}

}  // namespace
}  // namespace drift::strapdown::strapdown_fit_test
