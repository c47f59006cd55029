#include "core/estimate/sequential/attitude_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/estimate/sequential/small_cholesky.hpp"

namespace drift {

AttitudeFilter::AttitudeFilter(std::size_t parameters, std::vector<std::size_t> walking, bool holds)
    : parameters_(parameters),
      width_(Information::row_width(parameters)),
      walking_(std::move(walking)),
      holds_(holds),
      U_(most_moving * width_, 0.0) {
  DRIFT_DEMAND(walking_.size() <= most_walking);
}

void AttitudeFilter::reset() {
  std::ranges::fill(U_, 0.0);
  P_.setZero();
}

void AttitudeFilter::cage(const Vec3& psi, double sigma) {
  P_.topRows<3>().setZero();
  P_.leftCols<3>().setZero();
  P_.diagonal().head<3>().setConstant(sigma * sigma);
  std::fill(row(0), row(3), 0.0);
  for (std::size_t i = 0; i < 3; ++i) row(i)[right()] = -psi[static_cast<Eigen::Index>(i)];
}

template <int m>
void AttitudeFilter::propagate_rows(const Moving& F, const Rows3& G) {
  const auto of_G = static_cast<std::size_t>(G.cols());
  for (std::size_t c = 0; c < width_; c += lane_width) {
    Lanes u[m];
#pragma GCC unroll 9
    for (std::size_t j = 0; j < m; ++j) u[j] = load(row(j) + c);
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
      Lanes sum = c < of_G ? load(G.data() + i * of_G + c) : broadcast(0.0);
#pragma GCC unroll 9
      for (std::size_t j = 0; j < m; ++j)
        sum = mul_add(
            u[j], broadcast(F(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))), sum);
      store(row(i) + c, sum);
    }
  }
}

template <class Body>
decltype(auto) AttitudeFilter::with_states(Body&& body) const {
  if (holds_) return body.template operator()<most_moving>();
  if (!walking_.empty()) return body.template operator()<3 + most_walking>();
  return body.template operator()<3>();
}

void AttitudeFilter::hold(double variance) {
  P_.bottomRows<3>().setZero();
  P_.rightCols<3>().setZero();
  P_.diagonal().tail<3>().setConstant(variance);
  std::fill(row(first_held), row(most_moving), 0.0);
}

void AttitudeFilter::walk_anew(std::size_t k, double variance) {
  const auto i = static_cast<Eigen::Index>(3 + k);
  P_.row(i).setZero();
  P_.col(i).setZero();
  P_(i, i) = variance;
  std::fill(row(3 + k), row(4 + k), 0.0);
}

void AttitudeFilter::propagate(const Mat3& Phi, const Rows3& G, const Mat3& N) {
  Moving F = Moving::Identity();
  F.topLeftCorner<3, 3>() = Phi;
  for (std::size_t k = 0; k < walking_.size(); ++k)
    F.block<3, 1>(0, static_cast<Eigen::Index>(3 + k)) =
        G.col(static_cast<Eigen::Index>(walking_[k]));
  if (holds_) F.topRightCorner<3, 3>() = N;
  with_states([&]<int m>() {
    propagate_rows<m>(F, G);
    const auto f = F.topLeftCorner<m, m>();
    const Eigen::Matrix<double, m, m> P = f * P_.topLeftCorner<m, m>() * f.transpose();
    P_.topLeftCorner<m, m>() = 0.5 * (P + P.transpose());
  });
}

/// rows += H U.
template <int m>
void AttitudeFilter::predict_rows(const Measuring& H, double* rows) const {
  for (std::size_t c = 0; c < width_; c += lane_width) {
    Lanes u[m];
#pragma GCC unroll 9
    for (std::size_t j = 0; j < m; ++j) u[j] = load(row(j) + c);
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
      Lanes sum = load(rows + i * width_ + c);
#pragma GCC unroll 9
      for (std::size_t j = 0; j < m; ++j)
        sum = mul_add(
            u[j], broadcast(H(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))), sum);
      store(rows + i * width_ + c, sum);
    }
  }
}

/// U -= gain rows.
template <int m>
void AttitudeFilter::correct_rows(const Gain& gain, const double* rows) {
  for (std::size_t c = 0; c < width_; c += lane_width) {
    Lanes t[3];
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) t[i] = load(rows + i * width_ + c);
#pragma GCC unroll 9
    for (std::size_t j = 0; j < m; ++j) {
      Lanes sum = load(row(j) + c);
#pragma GCC unroll 3
      for (std::size_t i = 0; i < 3; ++i)
        sum = mul_add(t[i],
                      broadcast(-gain(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i))),
                      sum);
      store(row(j) + c, sum);
    }
  }
}

std::optional<std::size_t> AttitudeFilter::update(const Scalars& scalars, const Gate* gate,
                                                  double* rows) {
  std::fill(rows, rows + 3 * width_, 0.0);
  Measuring H = Measuring::Zero();
  H.leftCols<3>() = scalars.H_psi;
  if (holds_ && scalars.H_held != nullptr) H.rightCols<3>() = *scalars.H_held;
  const auto add = [&](const Rows3* from, std::size_t first) {
    if (from == nullptr || from->cols() == 0) return;
    const std::size_t count = std::min(static_cast<std::size_t>(from->cols()), parameters_ - first);
    for (std::size_t i = 0; i < 3; ++i)
      std::copy_n(from->data() + i * static_cast<std::size_t>(from->cols()), count,
                  rows + i * width_ + first);
  };
  add(scalars.H_rate, 0);
  add(scalars.H_par, scalars.first_par);
  if (scalars.H_rate != nullptr && scalars.H_rate->cols() > 0)
    for (std::size_t k = 0; k < walking_.size(); ++k)
      H.col(static_cast<Eigen::Index>(3 + k)) =
          scalars.H_rate->col(static_cast<Eigen::Index>(walking_[k]));
  Vec3 nu = scalars.nu;
  for (std::size_t i = 0; i < 3; ++i)
    rows[i * width_ + right()] =
        std::isfinite(nu[static_cast<Eigen::Index>(i)]) ? nu[static_cast<Eigen::Index>(i)] : 0.0;
  with_states([&]<int m>() { predict_rows<m>(H, rows); });

  Mat3 S = with_states([&]<int m>() -> Mat3 {
    return H.leftCols<m>() * P_.topLeftCorner<m, m>() * H.leftCols<m>().transpose();
  });
  S.diagonal().array() += scalars.sigma * scalars.sigma;
  if (gate != nullptr)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double* t = rows + i * width_;
      const double off = t[right()] - gate->x->dot(Eigen::Map<const VecX>(
                                          t, static_cast<Eigen::Index>(parameters_)));
      if (std::abs(off) > gate->gate * std::sqrt(S(at, at) + gate->known->variance_of(t)))
        nu[at] = std::numeric_limits<double>::quiet_NaN();
    }
  // A scalar that was not measured becomes one of zero sensitivity, zero innovation, unit noise.
  std::size_t used = 3;
  for (int i = 0; i < 3; ++i) {
    if (std::isfinite(nu[i])) continue;
    --used;
    H.row(i).setZero();
    S.row(i).setZero();
    S.col(i).setZero();
    S(i, i) = 1.0;
    std::fill_n(rows + static_cast<std::size_t>(i) * width_, width_, 0.0);
  }
  Mat3 L_inv;
  if (!inverse_cholesky(S, L_inv)) return {};
  for (std::size_t c = 0; c < width_; c += lane_width) {
    const Lanes a = load(rows + c), b = load(rows + width_ + c), d = load(rows + 2 * width_ + c);
    store(rows + c, mul_add(a, broadcast(L_inv(0, 0)), broadcast(0.0)));
    store(rows + width_ + c,
          mul_add(b, broadcast(L_inv(1, 1)), mul_add(a, broadcast(L_inv(1, 0)), broadcast(0.0))));
    store(rows + 2 * width_ + c,
          mul_add(d, broadcast(L_inv(2, 2)),
                  mul_add(b, broadcast(L_inv(2, 1)),
                          mul_add(a, broadcast(L_inv(2, 0)), broadcast(0.0)))));
  }
  with_states([&]<int m>() {
    Gain gain;
    gain.topRows<m>() = P_.topLeftCorner<m, m>() * H.leftCols<m>().transpose() * L_inv.transpose();
    correct_rows<m>(gain, rows);
    const Eigen::Matrix<double, m, m> P =
        P_.topLeftCorner<m, m>() - gain.topRows<m>() * gain.topRows<m>().transpose();
    P_.topLeftCorner<m, m>() = 0.5 * (P + P.transpose());
  });
  return used;
}

double AttitudeFilter::estimate(std::size_t i, const VecX& x) const {
  return x.dot(Eigen::Map<const VecX>(row(i), static_cast<Eigen::Index>(parameters_))) -
         row(i)[right()];
}

Vec3 AttitudeFilter::attitude(const VecX& x) const {
  return {estimate(0, x), estimate(1, x), estimate(2, x)};
}

void AttitudeFilter::move_reference(const VecX& x) {
  for (std::size_t i = 0; i < 3; ++i) row(i)[right()] = 0.0;
  for (std::size_t i = 3; i < most_moving; ++i) row(i)[right()] = -estimate(i, x);
}

}  // namespace drift
