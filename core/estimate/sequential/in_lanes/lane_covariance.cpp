#include "core/estimate/sequential/in_lanes/lane_covariance.hpp"

#include <algorithm>

#include "core/estimate/sequential/in_lanes/lane_tiles.hpp"

namespace drift {

LaneCovariance::LaneCovariance(std::size_t parameters)
    : n_(parameters),
      side_((parameters + 3) / 4),
      P_(index(side_, 0)),
      rows_((parameters / 4 + 1) * row_tile, Pack(0.0)),
      V_(rows_),
      gain_(rows_) {
  reset();
}

void LaneCovariance::reset() {
  for (auto& tile : P_) tile.fill(Pack(0.0));
  for (std::size_t k = 0; k < n_; ++k) P_[index(k / 4, k / 4)][5 * (k % 4)] = Pack(1.0);
  owed_ = false;
}

/// V = P t^T, after what is owed has been taken off P.
template <bool owed>
void LaneCovariance::multiply() {
  std::ranges::fill(V_, Pack(0.0));
  for (std::size_t I = 0; I < side_; ++I) {
    const Pack *t_I = &rows_[I * row_tile], *g_I = &gain_[I * row_tile];
    Pack v_I[row_tile];
#pragma GCC unroll 12
    for (std::size_t e = 0; e < row_tile; ++e) v_I[e] = V_[I * row_tile + e];
    for (std::size_t J = 0; J <= I; ++J) {
      Pack* stored = P_[index(I, J)].data();
      const Pack* t_J = &rows_[J * row_tile];
      Pack tile[16];
      load_tile(stored, tile);
      if constexpr (owed) {
        const Pack* g_J = &gain_[J * row_tile];
#pragma GCC unroll 3
        for (int r = 0; r < 3; ++r) add_product<Sign::minus>(g_I + 4 * r, g_J + 4 * r, tile);
        store_tile(tile, stored);
      }
#pragma GCC unroll 3
      for (int r = 0; r < 3; ++r)
#pragma GCC unroll 4
        for (int i = 0; i < 4; ++i)
#pragma GCC unroll 4
          for (int j = 0; j < 4; ++j)
            v_I[4 * r + i] = mul_add(tile[4 * i + j], t_J[4 * r + j], v_I[4 * r + i]);
      if (J == I) continue;
      Pack* v_J = &V_[J * row_tile];
#pragma GCC unroll 3
      for (int r = 0; r < 3; ++r)
#pragma GCC unroll 4
        for (int j = 0; j < 4; ++j) {
          Pack sum = v_J[4 * r + j];
#pragma GCC unroll 4
          for (int i = 0; i < 4; ++i) sum = mul_add(tile[4 * i + j], t_I[4 * r + i], sum);
          v_J[4 * r + j] = sum;
        }
    }
#pragma GCC unroll 12
    for (std::size_t e = 0; e < row_tile; ++e) V_[I * row_tile + e] = v_I[e];
  }
}

PackVec LaneCovariance::take(std::vector<Pack>& step) {
  if (owed_)
    multiply<true>();
  else
    multiply<false>();
  PackMat S = in_all_lanes(Mat3::Identity());
  for (std::size_t I = 0; I < side_; ++I)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c)
        for (int i = 0; i < 4; ++i)
          S(r, c) = mul_add(rows_[I * row_tile + static_cast<std::size_t>(4 * r + i)],
                            V_[I * row_tile + static_cast<std::size_t>(4 * c + i)], S(r, c));
  const InverseRoot L_inv(S);
  const Pack* right = at(n_);
  const PackVec white = L_inv.times({right[0], right[4], right[8]});
  for (std::size_t I = 0; I < side_; ++I) {
    const Pack* v = &V_[I * row_tile];
    Pack* g = &gain_[I * row_tile];
    for (std::size_t i = 0; i < 4; ++i) {
      const PackVec u = L_inv.times({v[i], v[4 + i], v[8 + i]});
      for (std::size_t r = 0; r < 3; ++r) g[4 * r + i] = u[static_cast<int>(r)];
      if (const std::size_t k = 4 * I + i; k < n_)
        step[k] = mul_add(u[0], white[0], mul_add(u[1], white[1], u[2] * white[2]));
    }
  }
  owed_ = true;
  return white;
}

double LaneCovariance::element(std::size_t i, std::size_t j, int lane) const {
  double p = P_[index(i / 4, j / 4)][4 * (i % 4) + j % 4][lane];
  for (std::size_t r = 0; owed_ && r < 3; ++r)
    p -= gain_[i / 4 * row_tile + 4 * r + i % 4][lane] *
         gain_[j / 4 * row_tile + 4 * r + j % 4][lane];
  return p;
}

void LaneCovariance::extract(int lane, MatX& P) const {
  P.resize(static_cast<Eigen::Index>(n_), static_cast<Eigen::Index>(n_));
  const auto at = [](std::size_t k) { return static_cast<Eigen::Index>(k); };
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j <= i; ++j) P(at(i), at(j)) = P(at(j), at(i)) = element(i, j, lane);
}

}  // namespace drift
