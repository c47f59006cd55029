#include "core/estimate/sequential/in_lanes/lane_filter.hpp"

#include <algorithm>

#include "core/estimate/sequential/in_lanes/lane_covariance.hpp"
#include "core/estimate/sequential/in_lanes/lane_information.hpp"
#include "core/estimate/sequential/in_lanes/lane_tiles.hpp"

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
    const Pack from[3] = {u[0], u[1], u[2]};
    for (std::size_t i = 0; i < 3; ++i)
      u[i] = row_times(Phi, static_cast<int>(i), from, k < rate_ ? G[3 * k + i] : Pack(0.0));
  }
  const PackMat P = times(times(Phi, P_), PackMat(Phi.transpose()));
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) P_(i, j) = Pack(0.5) * (P(i, j) + P(j, i));
}

template <class Rows>
void LaneFilter::update(Scalars& scalars, Rows& into) {
  PackMat& H = scalars.H_psi;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) H(i, j) *= scalars.on[i];
  const PackMat PHt = times(P_, PackMat(H.transpose()));
  PackMat S = times(H, PHt);
  for (int i = 0; i < 3; ++i) S(i, i) += Pack(scalars.sigma * scalars.sigma);
  const InverseRoot L_inv(S);
  PackMat gain;  // P H^T L^-T
  for (int i = 0; i < 3; ++i)
    gain.row(i) = L_inv.times({PHt(i, 0), PHt(i, 1), PHt(i, 2)}).transpose();
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
    const PackVec white = L_inv.times({t[0], t[1], t[2]});
    Pack* row = into.at(k);
    for (int i = 0; i < 3; ++i) row[4 * i] = white[i];
    for (int i = 0; i < 3; ++i) u[i] = row_times(minus, i, white.data(), u[i]);
  }
  const PackMat P = P_ - times(gain, PackMat(gain.transpose()));
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) P_(i, j) = Pack(0.5) * (P(i, j) + P(j, i));
}

template void LaneFilter::update(Scalars&, LaneInformation&);
template void LaneFilter::update(Scalars&, LaneCovariance&);

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
