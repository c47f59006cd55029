#include "core/estimate/sequential/in_lanes/lane_information.hpp"

#include <algorithm>

#include "core/estimate/sequential/in_lanes/lane_tiles.hpp"

namespace drift {
namespace {

/// sum += x y^T over rows of four numbers.
void add_rows(const Pack* x, const Pack* y, std::size_t rows, Pack* sum) {
  Pack tile[16];
  load_tile(sum, tile);
  for (std::size_t r = 0; r < rows; ++r, x += 4, y += 4) add_product<Sign::plus>(x, y, tile);
  store_tile(tile, sum);
}

/// A tile of the factor below the diagonal (or, where they are the same, on it), all that hangs on
/// tiles before taken off: times the inverse of the triangle d.
[[gnu::always_inline]] inline void divide(const Pack (&d)[16], const Pack* inverse,
                                          Pack (&tile)[16]) {
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j)
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
#pragma GCC unroll 4
      for (int q = 0; q < j; ++q)
        tile[4 * i + j] = mul_add(-tile[4 * i + q], d[4 * j + q], tile[4 * i + j]);
      tile[4 * i + j] *= inverse[j];
    }
}
/// A tile on the diagonal becomes its triangle.
[[gnu::always_inline]] inline void take_root(Pack (&tile)[16], Pack* inverse) {
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j)
#pragma GCC unroll 4
    for (int i = j; i < 4; ++i) {
#pragma GCC unroll 4
      for (int q = 0; q < j; ++q)
        tile[4 * i + j] = mul_add(-tile[4 * i + q], tile[4 * j + q], tile[4 * i + j]);
      if (i == j) inverse[j] = Pack(1.0) / sqrt(tile[5 * j]);
      tile[4 * i + j] *= inverse[j];
    }
}

/// L^-1 times a tile whose rows of four stand one after the other. triangle: L, transposed.
[[gnu::always_inline]] inline void solve_rows(const Pack* triangle, const Pack* inverse,
                                              Pack (&tile)[16]) {
#pragma GCC unroll 4
  for (int q = 0; q < 4; ++q)
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j) {
      tile[4 * q + j] *= inverse[q];
#pragma GCC unroll 4
      for (int i = q + 1; i < 4; ++i)
        tile[4 * i + j] = mul_add(-triangle[4 * q + i], tile[4 * q + j], tile[4 * i + j]);
    }
}

}  // namespace

LaneInformation::LaneInformation(std::size_t parameters)
    : n_(parameters),
      tiles_(parameters / 4 + 1),
      sum_(index(tiles_, 0)),
      neighbours_(sum_.size()),
      factor_(sum_.size()),
      inverse_(sum_.size()),
      inverse_factor_(sum_.size()),
      inverse_diagonal_(4 * tiles_, Pack(1.0)),
      panel_(tiles_ * most_rows * 4, Pack(0.0)),
      beside_(panel_) {
  for (auto& pairs : pairs_) pairs.reserve(most_rows / 3);
  clear();
}

void LaneInformation::clear() {
  for (Tile& t : sum_) t.fill(Pack(0.0));
  for (Tile& t : neighbours_) t.fill(Pack(0.0));
  for (auto& pairs : pairs_) pairs.clear();
  rows_ = carried;
  any_ = {};
}

void LaneInformation::begin_rows(int channel, bool follows) {
  const auto c = static_cast<std::size_t>(channel);
  now_ = rows_;
  rows_ += 3;
  if (follows && any_[c]) pairs_[c].push_back({last_[c], now_});
  last_[c] = now_;
  any_[c] = true;
}

void LaneInformation::flush(bool neighbours) {
  for (std::size_t I = 0; I < tiles_; ++I)
    for (std::size_t J = 0; J <= I; ++J)
      add_rows(panel(I, carried), panel(J, carried), rows_ - carried, sum_[index(I, J)].data());
  if (neighbours) add_neighbours();
  for (auto& pairs : pairs_) pairs.clear();
  for (std::size_t c = 0; c < 2; ++c) {
    if (!any_[c] || last_[c] == 3 * c) continue;
    for (std::size_t I = 0; I < tiles_; ++I)
      std::copy_n(panel(I, last_[c]), 12, &panel_[(I * most_rows + 3 * c) * 4]);
    last_[c] = 3 * c;
  }
  rows_ = carried;
}

/// Of three in a row the one in the middle stands for two pairs, s w^T + w u^T, and its transpose.
void LaneInformation::add_neighbours() {
  std::array<std::size_t, most_rows> middle{};
  std::size_t count = 0;  // rows
  for (const auto& pairs : pairs_)
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const std::size_t m = pairs[k].after, before = pairs[k].before;
      const bool both = k + 1 < pairs.size() && pairs[k + 1].before == m;
      const std::size_t after = both ? pairs[k + 1].after : m;
      for (std::size_t I = 0; I < tiles_; ++I) {
        Pack* to = &beside_[(I * most_rows + count) * 4];
        const Pack *s = panel(I, before), *u = panel(I, after);
        for (std::size_t e = 0; e < 12; ++e) to[e] = both ? s[e] + u[e] : s[e];
      }
      for (std::size_t a = 0; a < 3; ++a) middle[count + a] = m + a;
      count += 3;
      k += both ? 1 : 0;
    }
  for (std::size_t I = 0; I < tiles_; ++I)
    for (std::size_t J = 0; J <= I; ++J) {
      Pack* sum = neighbours_[index(I, J)].data();
      Pack tile[16];
      load_tile(sum, tile);
      for (std::size_t r = 0; r < count; ++r) {
        add_product<Sign::plus>(panel(I, middle[r]), &beside_[(J * most_rows + r) * 4], tile);
        add_product<Sign::plus>(&beside_[(I * most_rows + r) * 4], panel(J, middle[r]), tile);
      }
      store_tile(tile, sum);
    }
}

void LaneInformation::factorise() {
  const std::size_t side = (n_ + 3) / 4;
  for (std::size_t J = 0; J < side; ++J) {
    Pack root[16], *inverse = &inverse_diagonal_[4 * J];
    for (std::size_t I = J; I < side; ++I) {
      Pack tile[16];
      load_tile(sum_[index(I, J)].data(), tile);
      if (4 * I + 4 > n_) {  // what stands beyond the parameters is no part of it
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j)
            if (std::max(4 * I + i, 4 * J + j) >= n_) tile[4 * i + j] = Pack(0.0);
      }
      if (I == J)
        for (int i = 0; i < 4; ++i) tile[5 * i] += Pack(1.0);
      const Pack *x = factor_[index(I, 0)].data(), *y = factor_[index(J, 0)].data();
      for (std::size_t K = 0; K < J; ++K, x += 16, y += 16)
        for (int q = 0; q < 4; ++q) add_product<Sign::minus>(x + 4 * q, y + 4 * q, tile);
      if (I == J) {
        take_root(tile, inverse);
        load_tile(tile, root);
      } else {
        divide(root, inverse, tile);
      }
      // A row of four in a tile of the factor is a column of it: what products take together.
      Pack* to = factor_[index(I, J)].data();
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) to[4 * j + i] = tile[4 * i + j];
    }
  }
}

void LaneInformation::solve(Pack* x) const {
  for (std::size_t i = 0; i < n_; ++i) {
    Pack even = x[i], odd(0.0);
    std::size_t k = 0;
    for (; k + 1 < i; k += 2) {
      even = mul_add(-factor(i, k), x[k], even);
      odd = mul_add(-factor(i, k + 1), x[k + 1], odd);
    }
    if (k < i) even = mul_add(-factor(i, k), x[k], even);
    x[i] = (even + odd) * inverse_diagonal_[i];
  }
  for (std::size_t i = n_; i-- > 0;) {
    x[i] *= inverse_diagonal_[i];
    for (std::size_t k = 0; k < i; ++k) x[k] = mul_add(-factor(i, k), x[i], x[k]);
  }
}

void LaneInformation::whiten(Pack* rows) const {
  for (std::size_t I = 0; 4 * I < n_; ++I) {
    Pack tile[16];
    load_tile(rows + 16 * I, tile);
    for (std::size_t K = 0; K < I; ++K) {
      const Pack *l = factor_[index(I, K)].data(), *y = rows + 16 * K;
      for (int q = 0; q < 4; ++q) add_product<Sign::minus>(l + 4 * q, y + 4 * q, tile);
    }
    solve_rows(factor_[index(I, I)].data(), &inverse_diagonal_[4 * I], tile);
    store_tile(tile, rows + 16 * I);
  }
}

/// The factor's inverse W column after column of tiles, then P = W^T W.
void LaneInformation::invert() {
  const std::size_t side = (n_ + 3) / 4;
  for (std::size_t J = 0; J < side; ++J)
    for (std::size_t I = J; I < side; ++I) {
      Pack tile[16];
      for (Pack& e : tile) e = Pack(0.0);
      if (I == J)
        for (int i = 0; i < 4; ++i) tile[5 * i] = Pack(1.0);
      for (std::size_t K = J; K < I; ++K) {
        const Pack *l = factor_[index(I, K)].data(), *w = inverse_factor_[index(K, J)].data();
        for (int q = 0; q < 4; ++q) add_product<Sign::minus>(l + 4 * q, w + 4 * q, tile);
      }
      solve_rows(factor_[index(I, I)].data(), &inverse_diagonal_[4 * I], tile);
      store_tile(tile, inverse_factor_[index(I, J)].data());
    }
  for (std::size_t I = 0; I < side; ++I)
    for (std::size_t J = 0; J <= I; ++J) {
      Pack tile[16];
      for (Pack& e : tile) e = Pack(0.0);
      for (std::size_t K = I; K < side; ++K) {
        const Pack *x = inverse_factor_[index(K, I)].data(),
                   *y = inverse_factor_[index(K, J)].data();
        for (int q = 0; q < 4; ++q) add_product<Sign::plus>(x + 4 * q, y + 4 * q, tile);
      }
      store_tile(tile, inverse_[index(I, J)].data());
    }
}

void LaneInformation::extract(std::span<MatX* const> lanes) const {
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double of_lanes[Pack::width];
      element(inverse_, i, j).store(of_lanes);
      const auto at_i = static_cast<Eigen::Index>(i), at_j = static_cast<Eigen::Index>(j);
      for (std::size_t l = 0; l < lanes.size(); ++l)
        (*lanes[l])(at_i, at_j) = (*lanes[l])(at_j, at_i) = of_lanes[l];
    }
}

Pack LaneInformation::lagged(const Pack* d) const {
  Pack sum(0.0);
  for (std::size_t i = 0; i <= n_; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const Pack v = i < n_ ? -d[i] : Pack(1.0), w = j < n_ ? -d[j] : Pack(1.0);
      const Pack weight = i < n_ ? mul_add(v, w, element(inverse_, i, j)) : v * w;
      sum = mul_add(Pack(i == j ? 0.5 : 1.0) * weight, element(neighbours_, i, j), sum);
    }
  return sum;
}

}  // namespace drift
