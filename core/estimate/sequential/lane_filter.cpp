#include "core/estimate/sequential/lane_filter.hpp"

#include <algorithm>

namespace drift {

LaneFilter::LaneFilter(const Layout& layout, const std::vector<LaneLinearizer::Entry>& readout)
    : parameters_(layout.size()),
      rate_(layout.num_rate),
      readout_(&readout),
      U_(3 * (parameters_ + 1)),
      row_(3 * (parameters_ - rate_), Pack(0.0)) {
  reset();
}

void LaneFilter::reset() {
  std::ranges::fill(U_, Pack(0.0));
  for (int e = 0; e < 9; ++e) P_.data()[e] = Pack(0.0);
}

void LaneFilter::cage(const PackVec& psi, double sigma) {
  reset();
  for (int i = 0; i < 3; ++i) {
    P_(i, i) = Pack(sigma * sigma);
    U_[3 * parameters_ + static_cast<std::size_t>(i)] = -psi[i];
  }
}

void LaneFilter::propagate(const PackMat& Phi, const std::vector<Pack>& G) {
  for (std::size_t k = 0; k <= parameters_; ++k) {
    Pack* u = &U_[3 * k];
    Pack moved[3];
    for (std::size_t i = 0; i < 3; ++i)
      moved[i] = row_times(Phi, static_cast<int>(i), u, k < rate_ ? G[3 * k + i] : Pack(0.0));
    std::copy_n(moved, 3, u);
  }
  const PackMat P = times(times(Phi, P_), PackMat(Phi.transpose()));
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) P_(i, j) = Pack(0.5) * (P(i, j) + P(j, i));
}

void LaneFilter::update(Scalars& scalars, LaneInformation& into) {
  PackMat& H = scalars.H_psi;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) H(i, j) *= scalars.on[i];
  const PackMat PHt = times(P_, PackMat(H.transpose()));
  PackMat S = times(H, PHt);
  for (int i = 0; i < 3; ++i) S(i, i) += Pack(scalars.sigma * scalars.sigma);
  // L^-1 of S = L L^T (small_cholesky.hpp); not a number in a lane in which S is not positive.
  const Pack one(1.0), i0 = one / sqrt(S(0, 0)), l10 = S(1, 0) * i0, l20 = S(2, 0) * i0;
  const Pack i1 = one / sqrt(S(1, 1) - l10 * l10), l21 = (S(2, 1) - l20 * l10) * i1;
  const Pack i2 = one / sqrt(S(2, 2) - l20 * l20 - l21 * l21);
  const Pack m10 = -(i1 * l10 * i0), m21 = -(i2 * l21 * i1), m20 = -(i2 * (l20 * i0 + l21 * m10));
  PackMat gain;  // P H^T L^-T
  for (int i = 0; i < 3; ++i) {
    gain(i, 0) = PHt(i, 0) * i0;
    gain(i, 1) = mul_add(PHt(i, 0), m10, PHt(i, 1) * i1);
    gain(i, 2) = mul_add(PHt(i, 0), m20, mul_add(PHt(i, 1), m21, PHt(i, 2) * i2));
  }
  const bool by_par = scalars.H_par != nullptr;
  if (by_par) {
    std::ranges::fill(row_, Pack(0.0));
    for (std::size_t e = 0; e < readout_->size(); ++e) {
      const auto [state, slot] = (*readout_)[e];
      row_[3 * state + static_cast<std::size_t>(slot)] += (*scalars.H_par)[e];
    }
  }
  const PackMat minus = -gain;
  const Pack* by_rate = scalars.H_rate ? scalars.H_rate->data() : nullptr;
  const Pack none[3] = {Pack(0.0), Pack(0.0), Pack(0.0)};
  for (std::size_t k = 0; k <= parameters_; ++k) {
    const Pack* h = none;
    if (k == parameters_)
      h = scalars.nu.data();
    else if (k >= rate_ && by_par)
      h = &row_[3 * (k - rate_)];
    else if (k < rate_ && by_rate)
      h = by_rate + 3 * k;
    Pack* u = &U_[3 * k];
    Pack t[3];
    for (int i = 0; i < 3; ++i) t[i] = row_times(H, i, u, h[i] * scalars.on[i]);
    const Pack white[3] = {i0 * t[0], mul_add(m10, t[0], i1 * t[1]),
                           mul_add(m20, t[0], mul_add(m21, t[1], i2 * t[2]))};
    Pack* row = into.at(k);
    for (int i = 0; i < 3; ++i) row[4 * i] = white[i];
    for (int i = 0; i < 3; ++i) u[i] = row_times(minus, i, white, u[i]);
  }
  const PackMat P = P_ - times(gain, PackMat(gain.transpose()));
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) P_(i, j) = Pack(0.5) * (P(i, j) + P(j, i));
}

PackVec LaneFilter::attitude(const std::vector<Pack>& x) const {
  PackVec psi;
  for (std::size_t i = 0; i < 3; ++i) {
    Pack sum = -U_[3 * parameters_ + i];
    for (std::size_t k = 0; k < parameters_; ++k) sum = mul_add(x[k], U_[3 * k + i], sum);
    psi[static_cast<int>(i)] = sum;
  }
  return psi;
}

void LaneFilter::move_reference() {
  for (std::size_t i = 0; i < 3; ++i) U_[3 * parameters_ + i] = Pack(0.0);
}

}  // namespace drift
