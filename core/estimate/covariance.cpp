#include "core/estimate/covariance.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace drift {
namespace {

/// a + b c, fused where the machine has it: the same bits for a given instruction set.
inline double mul_add(double b, double c, double a) {
#ifdef __FMA__
  return __builtin_fma(b, c, a);
#else
  return a + b * c;
#endif
}

/// out[i] (+)= sum_j P(i, j) G(:, j) over the given columns, three sums at a time.
void accumulate(const MatX& P, const Eigen::Ref<const Mat3X>& G, std::size_t first_column, MatX3& out) {
  const Eigen::Index n = P.rows();
  double* __restrict o0 = out.col(0).data();
  double* __restrict o1 = out.col(1).data();
  double* __restrict o2 = out.col(2).data();
  for (Eigen::Index j = 0; j < G.cols(); ++j) {
    const double g0 = G(0, j), g1 = G(1, j), g2 = G(2, j);
    const double* __restrict p = P.data() + (first_column + j) * n;
    if (g0 == 0.0 && g1 == 0.0 && g2 == 0.0) continue;
    for (Eigen::Index i = 0; i < n; ++i) {
      o0[i] = mul_add(p[i], g0, o0[i]);
      o1[i] = mul_add(p[i], g1, o1[i]);
      o2[i] = mul_add(p[i], g2, o2[i]);
    }
  }
}

/// P -= U U^T for the columns of U in use. The products commute, so P stays symmetric bit by bit.
void downdate(MatX& P, const MatX3& U) {
  const Eigen::Index n = P.rows();
  const double* __restrict u0 = U.col(0).data();
  const double* __restrict u1 = U.col(1).data();
  const double* __restrict u2 = U.col(2).data();
  for (Eigen::Index j = 0; j < n; ++j) {
    double* __restrict p = P.data() + j * n;
    const double a = -u0[j], b = -u1[j], c = -u2[j];
    for (Eigen::Index i = 0; i < n; ++i)
      p[i] = mul_add(u2[i], c, mul_add(u1[i], b, mul_add(u0[i], a, p[i])));
  }
}

}  // namespace

Covariance::Covariance(std::size_t parameters, std::size_t num_rate, double sigma_attitude)
    : num_rate_(num_rate),
      P_pa_(MatX3::Zero(parameters, 3)),
      P_pp_(MatX::Identity(parameters, parameters)),
      work_(MatX3::Zero(parameters, 3)),
      gain_(MatX3::Zero(parameters, 3)) {
  recage(sigma_attitude);
}

void Covariance::recage(double sigma_attitude) {
  P_aa_ = sigma_attitude * sigma_attitude * Mat3::Identity();
  P_pa_.setZero();
}

void Covariance::propagate(const Mat3& Phi, const Eigen::Ref<const Mat3X>& G, const Mat3& Q) {
  const auto nr = static_cast<Eigen::Index>(num_rate_);
  const Mat3 cross = G * P_pa_.topRows(nr);  // G P_pa
  work_.setZero();
  accumulate(P_pp_, G, 0, work_);            // P_pp G^T
  const Mat3 second = Phi * cross.transpose();
  const Mat3 P = Phi * P_aa_ * Phi.transpose() + second + second.transpose() + G * work_.topRows(nr) + Q;
  P_aa_ = 0.5 * (P + P.transpose());
  gain_.noalias() = P_pa_ * Phi.transpose();
  P_pa_ = gain_ + work_;
}

Covariance::Update Covariance::update(const Vec3& nu, const Mat3& H_psi,
                                      const Eigen::Ref<const Mat3X>& H_par, std::size_t first,
                                      double sigma, VecX& x) {
  Update out;
  // A scalar that was not measured becomes one of zero sensitivity, zero innovation, unit noise.
  Mat3 H = H_psi;
  Vec3 innovation = nu;
  Vec3 variance = Vec3::Constant(sigma * sigma);
  std::array<bool, 3> used{true, true, true};
  for (int i = 0; i < 3; ++i) {
    if (std::isfinite(nu[i])) {
      ++out.scalars;
      continue;
    }
    used[i] = false;
    H.row(i).setZero();
    innovation[i] = 0.0;
    variance[i] = 1.0;
  }
  if (out.scalars == 0) return out;

  const Eigen::Index m = H_par.cols(), at = static_cast<Eigen::Index>(first);
  Mat3 V_a = P_aa_ * H.transpose();
  work_.noalias() = P_pa_ * H.transpose();
  if (m > 0) {
    Mat3 keep = Mat3::Zero();
    for (int i = 0; i < 3; ++i) keep(i, i) = used[i] ? 1.0 : 0.0;
    V_a.noalias() += P_pa_.middleRows(at, m).transpose() * H_par.transpose() * keep;
    if (out.scalars == 3) {
      accumulate(P_pp_, H_par, first, work_);
    } else {
      gain_.setZero();
      accumulate(P_pp_, H_par, first, gain_);
      work_.noalias() += gain_ * keep;
    }
  }
  Mat3 S = H * V_a;
  if (m > 0) {
    for (int i = 0; i < 3; ++i)
      if (used[i]) S.row(i).noalias() += H_par.row(i) * work_.middleRows(at, m);
  }
  S = 0.5 * (S + S.transpose()).eval();
  S.diagonal() += variance;
  const Eigen::LLT<Mat3> llt(S);
  if (llt.info() != Eigen::Success || !(S.diagonal().minCoeff() > 0.0)) {
    out.ok = false;
    return out;
  }
  // U = V L^-T, so that P <- P - U U^T and the correction is U L^-1 nu.
  const Mat3 L = llt.matrixL();
  Mat3 L_inv = Mat3::Identity();
  L.triangularView<Eigen::Lower>().solveInPlace(L_inv);
  const Vec3 e = L_inv * innovation;
  out.nis = e.squaredNorm();
  gain_.noalias() = work_ * L_inv.transpose();
  const Mat3 U_a = V_a * L_inv.transpose();
  out.attitude = U_a * e;
  x.noalias() += gain_ * e;
  const Mat3 P = P_aa_ - U_a * U_a.transpose();
  P_aa_ = 0.5 * (P + P.transpose());
  P_pa_.noalias() -= gain_ * U_a.transpose();
  downdate(P_pp_, gain_);
  return out;
}

}  // namespace drift
