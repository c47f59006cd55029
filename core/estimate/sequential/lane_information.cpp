#include "core/estimate/sequential/lane_information.hpp"

#include <algorithm>

namespace drift {
namespace {

/// tile +-= x y^T for `rows` times four numbers x and y.
enum class Sign { plus, minus };
template <Sign sign>
inline void add_products(const Pack* x, const Pack* y, std::size_t rows, Pack* tile) {
  Pack a[16];
#pragma GCC unroll 16
  for (int e = 0; e < 16; ++e) a[e] = tile[e];
  for (std::size_t r = 0; r < rows; ++r, x += 4, y += 4) {
    const Pack y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3];
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) {
      const Pack xi = sign == Sign::plus ? x[i] : -x[i];
      a[4 * i] = mul_add(xi, y0, a[4 * i]);
      a[4 * i + 1] = mul_add(xi, y1, a[4 * i + 1]);
      a[4 * i + 2] = mul_add(xi, y2, a[4 * i + 2]);
      a[4 * i + 3] = mul_add(xi, y3, a[4 * i + 3]);
    }
  }
#pragma GCC unroll 16
  for (int e = 0; e < 16; ++e) tile[e] = a[e];
}

}  // namespace

LaneInformation::LaneInformation(std::size_t parameters)
    : n_(parameters),
      tiles_(parameters / 4 + 1),
      sum_(index(tiles_, 0)),
      neighbours_(sum_.size()),
      factor_(sum_.size()),
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
      add_products<Sign::plus>(panel(I, carried), panel(J, carried), rows_ - carried,
                               sum_[index(I, J)].data());
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
      Pack* tile = neighbours_[index(I, J)].data();
      for (std::size_t r = 0; r < count; r += 3) {
        add_products<Sign::plus>(panel(I, middle[r]), &beside_[(J * most_rows + r) * 4], 3, tile);
        add_products<Sign::plus>(&beside_[(I * most_rows + r) * 4], panel(J, middle[r]), 3, tile);
      }
    }
}

void LaneInformation::factorise() {
  const std::size_t side = (n_ + 3) / 4;
  for (std::size_t J = 0; J < side; ++J)
    for (std::size_t I = J; I < side; ++I) {
      Pack* a = factor_[index(I, J)].data();
      std::copy_n(sum_[index(I, J)].data(), 16, a);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          const std::size_t row = 4 * I + i, column = 4 * J + j;
          if (row >= n_ || column >= n_) a[4 * i + j] = Pack(0.0);
          if (row == column) a[4 * i + j] += Pack(1.0);
        }
      // A row of a tile of the factor is four numbers in a row: its transpose is taken here.
      for (std::size_t K = 0; K < J; ++K) {
        const Pack *x = factor_[index(I, K)].data(), *y = factor_[index(J, K)].data();
        Pack s[16];
        for (int e = 0; e < 16; ++e) s[e] = a[e];
        for (int q = 0; q < 4; ++q) {
          const Pack y0 = y[q], y1 = y[4 + q], y2 = y[8 + q], y3 = y[12 + q];
#pragma GCC unroll 4
          for (int i = 0; i < 4; ++i) {
            const Pack xi = -x[4 * i + q];
            s[4 * i] = mul_add(xi, y0, s[4 * i]);
            s[4 * i + 1] = mul_add(xi, y1, s[4 * i + 1]);
            s[4 * i + 2] = mul_add(xi, y2, s[4 * i + 2]);
            s[4 * i + 3] = mul_add(xi, y3, s[4 * i + 3]);
          }
        }
        for (int e = 0; e < 16; ++e) a[e] = s[e];
      }
      const Pack* d = factor_[index(J, J)].data();
      for (std::size_t j = 0; j < 4; ++j) {
        if (I == J) {
          Pack s = a[5 * j];
          for (std::size_t q = 0; q < j; ++q) s = mul_add(-a[4 * j + q], a[4 * j + q], s);
          inverse_diagonal_[4 * J + j] = Pack(1.0) / sqrt(s);
        }
        for (std::size_t i = I == J ? j : 0; i < 4; ++i) {
          Pack s = a[4 * i + j];
          for (std::size_t q = 0; q < j; ++q) s = mul_add(-a[4 * i + q], d[4 * j + q], s);
          a[4 * i + j] = s * inverse_diagonal_[4 * J + j];
        }
      }
    }
}

void LaneInformation::solve(Pack* x) const {
  for (std::size_t i = 0; i < n_; ++i) {
    Pack even = x[i], odd(0.0);
    std::size_t k = 0;
    for (; k + 1 < i; k += 2) {
      even = mul_add(-element(factor_, i, k), x[k], even);
      odd = mul_add(-element(factor_, i, k + 1), x[k + 1], odd);
    }
    if (k < i) even = mul_add(-element(factor_, i, k), x[k], even);
    x[i] = (even + odd) * inverse_diagonal_[i];
  }
  for (std::size_t i = n_; i-- > 0;) {
    x[i] *= inverse_diagonal_[i];
    for (std::size_t k = 0; k < i; ++k) x[k] = mul_add(-element(factor_, i, k), x[i], x[k]);
  }
}

void LaneInformation::extract(int lane, Information& into) const {
  into.fill([&](std::size_t i, std::size_t j) { return element(sum_, j, i)[lane]; });
}

double LaneInformation::lagged(int lane, const VecX& d, const MatX& P) const {
  double sum = 0.0;
  for (std::size_t i = 0; i <= n_; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const auto at_i = static_cast<Eigen::Index>(i), at_j = static_cast<Eigen::Index>(j);
      const double v = i < n_ ? -d[at_i] : 1.0, w = j < n_ ? -d[at_j] : 1.0;
      const double weight = v * w + (i < n_ && j < n_ ? P(at_i, at_j) : 0.0);
      sum += (i == j ? 0.5 : 1.0) * weight * element(neighbours_, i, j)[lane];
    }
  return sum;
}

}  // namespace drift
