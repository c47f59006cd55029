#include "core/estimate/sequential/covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdlib>
#include <limits>

namespace drift::covariance_test {
namespace {

/// A dense filter beside the structured one: x = [attitude, parameters].
struct Dense {
  MatX P;
  VecX x;
  void propagate(const MatX& F) { P = (F * P * F.transpose()).eval(); }
  void update(const VecX& nu, const MatX& H, double sigma) {
    const MatX S = H * P * H.transpose() + sigma * sigma * MatX::Identity(nu.size(), nu.size());
    const MatX K = P * H.transpose() * S.inverse();
    x += K * nu;
    P = (P - K * S * K.transpose()).eval();
  }
};

/// Sizes with and without whole blocks of lanes; scalars that are missing; updates in any order.
TEST(Covariance, AgreesWithADenseFilter) {
  std::srand(7);
  for (const Eigen::Index n : {1, 5, 13, 60, 61, 97}) {
    const Eigen::Index nr = (2 * n + 2) / 3, m = n - nr;
    Covariance P(n, nr, 0.5);
    VecX x = VecX::Zero(n);
    Dense dense{MatX::Identity(3 + n, 3 + n), VecX::Zero(3 + n)};
    dense.P.topLeftCorner<3, 3>() *= 0.25;
    for (int step = 0; step < 12; ++step) {
      const Mat3 Phi = Mat3::Identity() + 0.1 * Mat3::Random();
      const Rows3 G = Rows3::Random(3, nr);
      MatX F = MatX::Identity(3 + n, 3 + n);
      F.topLeftCorner<3, 3>() = Phi;
      F.block(0, 3, 3, nr) = G;
      P.propagate(Phi, G);
      dense.propagate(F);

      const bool readout = step % 3 != 1;  // then an update of the attitude alone
      Vec3 nu = Vec3::Random();
      const Mat3 H_psi = Mat3::Random();
      Rows3 H_par = readout ? Rows3::Random(3, m) : Rows3(3, 0);
      if (H_par.cols() > 1) H_par(1, 1) = 0.0;
      const Rows3 H_rate = step % 2 ? Rows3::Random(3, nr) : Rows3(3, 0);
      MatX H = MatX::Zero(3, 3 + n);
      H.leftCols<3>() = H_psi;
      H.middleCols(3, H_rate.cols()) = H_rate;
      H.rightCols(H_par.cols()) = H_par;
      const int missing = step % 4;  // 3: none
      if (missing < 3) nu[missing] = std::numeric_limits<double>::quiet_NaN();
      VecX nu_dense(missing < 3 ? 2 : 3);
      MatX H_dense(nu_dense.size(), 3 + n);
      for (int i = 0, k = 0; i < 3; ++i)
        if (i != missing) {
          nu_dense[k] = nu[i];
          H_dense.row(k++) = H.row(i);
        }
      dense.x.head<3>().setZero();
      const auto update = P.update(nu, H_psi, H_rate, H_par, 0.1, x);
      dense.update(nu_dense, H_dense, 0.1);
      EXPECT_TRUE(update.ok);
      EXPECT_EQ(update.scalars, nu_dense.size());
      const MatX pp = P.parameters();
      EXPECT_TRUE(pp == pp.transpose());
      EXPECT_LT((pp - dense.P.bottomRightCorner(n, n)).cwiseAbs().maxCoeff(), 1e-11) << n;
      EXPECT_LT((P.cross() - dense.P.bottomLeftCorner(n, 3)).cwiseAbs().maxCoeff(), 1e-11) << n;
      EXPECT_LT((P.attitude() - dense.P.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-11) << n;
      EXPECT_LT((update.attitude - dense.x.head<3>()).cwiseAbs().maxCoeff(), 1e-11) << n;
      EXPECT_LT((x - dense.x.tail(n)).cwiseAbs().maxCoeff(), 1e-10) << n;
      for (Eigen::Index k = 0; k < n; ++k) EXPECT_NEAR(P.variance(k), pp(k, k), 1e-15);
    }
  }
}

/// Noise that is held through two steps and two updates, as three more states of a dense filter.
TEST(Covariance, NoiseThatIsHeldIsThreeMoreStates) {
  std::srand(11);
  for (const Eigen::Index n : {4, 13, 60}) {
    const Eigen::Index nr = (2 * n + 2) / 3, m = n - nr, all = 6 + n;
    Covariance P(n, nr, 0.5);
    VecX x = VecX::Zero(n);
    Dense dense{MatX::Identity(all, all), VecX::Zero(all)};  // attitude, parameters, noise
    dense.P.topLeftCorner<3, 3>() *= 0.25;
    for (int sample = 0; sample < 4; ++sample) {
      const double variance = 0.3 + 0.1 * sample;
      P.hold(variance);
      dense.P.rightCols<3>().setZero();
      dense.P.bottomRows<3>().setZero();
      dense.P.bottomRightCorner<3, 3>() = variance * Mat3::Identity();
      dense.x.setZero();
      VecX x_before = x;
      for (const bool readout : {true, false}) {
        const Mat3 Phi = Mat3::Identity() + 0.1 * Mat3::Random(), N = Mat3::Random();
        const Rows3 G = Rows3::Random(3, nr);
        MatX F = MatX::Identity(all, all);
        F.topLeftCorner<3, 3>() = Phi;
        F.block(0, 3, 3, nr) = G;
        F.topRightCorner<3, 3>() = N;
        P.propagate(Phi, G);
        P.drive(N);
        dense.propagate(F);
        Vec3 nu = Vec3::Random();
        const Mat3 H_psi = Mat3::Random(), H_held = Mat3::Random();
        const Rows3 H_rate = readout ? Rows3::Random(3, nr) : Rows3(3, 0);
        const Rows3 H_par = readout ? Rows3::Random(3, m) : Rows3(3, 0);
        MatX H = MatX::Zero(3, all);
        H.leftCols<3>() = H_psi;
        H.middleCols(3, H_rate.cols()) = H_rate;
        if (readout) H.middleCols(3 + nr, m) = H_par;
        if (readout) H.rightCols<3>() = H_held;
        Eigen::Index measured = 3;
        if (readout && sample == 2) {  // the last scalar is missing
          nu[2] = std::numeric_limits<double>::quiet_NaN();
          measured = 2;
        }
        dense.x.setZero();
        const auto update = P.update(nu, H_psi, H_rate, H_par, 0.1, x, readout ? &H_held : nullptr);
        dense.update(nu.head(measured), H.topRows(measured), 0.1);
        EXPECT_TRUE(update.ok);
        EXPECT_LT((update.attitude - dense.x.head<3>()).norm(), 1e-11);
        EXPECT_LT((update.held - dense.x.tail<3>()).norm(), 1e-11);
        EXPECT_LT((x - x_before - dense.x.segment(3, n)).norm(), 1e-11);
        x_before = x;
        const MatX pp = P.parameters();
        EXPECT_TRUE(pp == pp.transpose());
        EXPECT_LT((pp - dense.P.block(3, 3, n, n)).cwiseAbs().maxCoeff(), 1e-11) << n;
        EXPECT_LT((P.cross() - dense.P.block(3, 0, n, 3)).cwiseAbs().maxCoeff(), 1e-11) << n;
        EXPECT_LT((P.attitude() - dense.P.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-11);
      }
    }
  }
}

}  // namespace
}  // namespace drift::covariance_test
