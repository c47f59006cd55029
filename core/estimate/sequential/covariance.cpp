#include "core/estimate/sequential/covariance.hpp"

#include <cmath>

#include "core/base/check.hpp"
#include "core/estimate/sequential/covariance_kernels.hpp"
#include "core/estimate/sequential/small_cholesky.hpp"

namespace drift {

Covariance::Covariance(std::size_t parameters, std::size_t num_rate, double sigma_attitude)
    : num_rate_(num_rate),
      P_pa_(MatX3::Zero(whole_lanes(parameters), 3)),
      P_pp_(MatX::Identity(whole_lanes(parameters), parameters)),
      work_(MatX3::Zero(whole_lanes(parameters), 3)),
      gain_(MatX3::Zero(whole_lanes(parameters), 3)),
      later_gain_(gain_),
      P_nn_(Mat3::Zero()),
      P_na_(Mat3::Zero()),
      P_pn_(work_),
      H_rate_(Rows3::Zero(3, static_cast<Eigen::Index>(num_rate))) {
  entries_.reserve(3 * parameters);
  recage(sigma_attitude);
}

void Covariance::reset(double sigma_attitude) {
  P_pp_.setIdentity();
  owed_ = false;
  recage(sigma_attitude);
}

void Covariance::recage(double sigma_attitude) {
  P_aa_ = sigma_attitude * sigma_attitude * Mat3::Identity();
  P_pa_.setZero();
  holds_ = false;
}

void Covariance::set_equal(std::size_t parameter, std::size_t other) {
  settle();
  const auto to = static_cast<Eigen::Index>(parameter), from = static_cast<Eigen::Index>(other);
  P_pp_.row(to) = P_pp_.row(from);
  P_pp_.col(to) = P_pp_.col(from);
  P_pa_.row(to) = P_pa_.row(from);
  P_pn_.row(to) = P_pn_.row(from);
}

void Covariance::hold(double variance) {
  holds_ = true;
  P_nn_ = variance * Mat3::Identity();
  P_na_.setZero();
  P_pn_.setZero();
}

void Covariance::drive(const Mat3& N) {
  const Mat3 NP = N * P_na_;
  P_aa_ += NP + NP.transpose() + N * P_nn_ * N.transpose();
  P_na_ += P_nn_ * N.transpose();
  times_transposed(P_pn_, N, P_pa_, &P_pa_);
}

void Covariance::propagate(const Mat3& Phi, const Eigen::Ref<const Rows3>& G) {
  DRIFT_DEMAND(static_cast<std::size_t>(G.cols()) == num_rate_);
  // With W = P_pa Phi^T and V = W + P_pp G^T, the new P_pa, the symmetric part of G (W + V) is
  // G W + (G W)^T + G P_pp G^T.
  times_transposed(P_pa_, Phi, work_);
  P_pa_ = work_;
  add_product(P_pp_, G, P_pa_);
  work_ += P_pa_;
  Mat3 Z = small_product(G, work_);
  if (owed_) {
    const Mat3 GU = small_product(G, gain_);
    Z -= GU * GU.transpose();
    times_transposed(gain_, -GU, P_pa_, &P_pa_);
  }
  const Mat3 P = Phi * P_aa_ * Phi.transpose() + Z;
  P_aa_ = 0.5 * (P + P.transpose());
  if (holds_) P_na_ = P_na_ * Phi.transpose() + small_product(G, P_pn_).transpose();
}

Covariance::Update Covariance::update(const Vec3& nu, const Mat3& H_psi,
                                      const Eigen::Ref<const Rows3>& H_rate,
                                      const Eigen::Ref<const Rows3>& H_par, double sigma, VecX& x,
                                      const Mat3* H_held) {
  Update out;
  // A scalar that was not measured becomes one of zero sensitivity, zero innovation, unit noise.
  Mat3 H = H_psi, H_n = holds_ && H_held ? *H_held : Mat3::Zero();
  Vec3 innovation = nu;
  Vec3 variance = Vec3::Constant(sigma * sigma);
  bool used[3];
  for (int i = 0; i < 3; ++i) {
    used[i] = std::isfinite(nu[i]);
    if (used[i]) {
      ++out.scalars;
      continue;
    }
    H.row(i).setZero();
    H_n.row(i).setZero();
    innovation[i] = 0.0;
    variance[i] = 1.0;
  }
  if (out.scalars == 0) return out;

  if (owed_ && (H_rate.cols() > 0 || H_par.cols() > 0)) {
    downdate(P_pp_, gain_);
    owed_ = false;
  }
  MatX3& U = owed_ ? later_gain_ : gain_;
  const bool by_rates = H_rate.cols() > 0;
  if (by_rates)
    for (int i = 0; i < 3; ++i) {
      if (used[i])
        H_rate_.row(i) = H_rate.row(i);
      else
        H_rate_.row(i).setZero();
    }
  const auto at = static_cast<Eigen::Index>(num_rate_);
  entries_.clear();
  std::size_t end[4] = {0, 0, 0, 0};  // entries of row i run from end[i] to end[i + 1]
  for (int i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; used[i] && j < H_par.cols(); ++j)
      if (const double h = H_par(i, j); h != 0.0) entries_.push_back({at + j, h});
    end[i + 1] = entries_.size();
  }
  // H_par(i, :) A over the rows of A that it meets.
  const auto row_product = [&](int i, const MatX3& A) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = end[i]; k < end[i + 1]; ++k)
      sum += entries_[k].value * A.row(entries_[k].column).transpose();
    return sum;
  };
  Mat3 V_a = P_aa_ * H.transpose();  // V = P H^T
  times_transposed(P_pa_, H, work_);
  if (by_rates) {
    V_a += small_product(H_rate_, P_pa_).transpose();
    add_product(P_pp_, H_rate_, work_);
  }
  for (int i = 0; i < 3; ++i) {
    if (end[i] == end[i + 1]) continue;
    V_a.col(i) += row_product(i, P_pa_);
    add_sparse_product(P_pp_, &entries_[end[i]], end[i + 1] - end[i], work_.col(i).data());
  }
  Mat3 V_n = Mat3::Zero();
  if (holds_) {
    V_n = P_na_ * H.transpose() + P_nn_ * H_n.transpose();
    V_a += P_na_.transpose() * H_n.transpose();
    if (by_rates) V_n += small_product(H_rate_, P_pn_).transpose();
    for (int i = 0; i < 3; ++i) V_n.col(i) += row_product(i, P_pn_);
    times_transposed(P_pn_, H_n, work_, &work_);
  }
  Mat3 S = H * V_a + H_n * V_n;
  if (by_rates) S += small_product(H_rate_, work_);
  for (int i = 0; i < 3; ++i)
    if (end[i] < end[i + 1]) S.row(i) += row_product(i, work_).transpose();
  S = 0.5 * (S + S.transpose()).eval();
  S.diagonal() += variance;
  Mat3 L_inv;
  if (!inverse_cholesky(S, L_inv)) {
    out.ok = false;
    return out;
  }
  // U = V L^-T, so that P <- P - U U^T and the correction is U L^-1 nu.
  const Vec3 e = L_inv * innovation;
  out.nis = e.squaredNorm();
  out.white = e;
  times_transposed(work_, L_inv, U);
  const Mat3 U_a = V_a * L_inv.transpose();
  out.attitude = U_a * e;
  const Eigen::Index n = x.size();
  x += U.col(0).head(n) * e[0] + U.col(1).head(n) * e[1] + U.col(2).head(n) * e[2];
  const Mat3 P = P_aa_ - U_a * U_a.transpose();
  P_aa_ = 0.5 * (P + P.transpose());
  times_transposed(U, -U_a, P_pa_, &P_pa_);
  if (holds_) {
    const Mat3 U_n = V_n * L_inv.transpose();
    out.held = U_n * e;
    P_nn_ -= U_n * U_n.transpose();
    P_na_ -= U_n * U_a.transpose();
    times_transposed(U, -U_n, P_pn_, &P_pn_);
  }
  if (owed_) downdate(P_pp_, gain_, later_gain_);
  owed_ = !owed_;
  return out;
}

MatX Covariance::parameters() const {
  MatX P = P_pp_;
  if (owed_) downdate(P, gain_);
  return P.topRows(P.cols());
}

void Covariance::settle() {
  if (owed_) downdate(P_pp_, gain_);
  owed_ = false;
}

}  // namespace drift
