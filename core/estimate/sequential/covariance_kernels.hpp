#pragma once

#include "core/estimate/lanes.hpp"
#include "core/estimate/sequential/covariance.hpp"

/// Products of tall narrow matrices, of which Covariance is made: whole lanes of rows at once.
namespace drift {

/// out = in M^T, plus `plus` if given. out may be in or plus.
inline void times_transposed(const MatX3& in, const Mat3& M, MatX3& out,
                             const MatX3* plus = nullptr) {
  const std::size_t rows = in.rows();
  for (std::size_t row = 0; row < rows; row += lane_width) {
    const Lanes a = load(&in(row, 0)), b = load(&in(row, 1)), c = load(&in(row, 2));
    for (int k = 0; k < 3; ++k) {
      Lanes sum = plus ? load(&(*plus)(row, k)) : broadcast(0.0);
      sum = mul_add(a, broadcast(M(k, 0)), sum);
      sum = mul_add(b, broadcast(M(k, 1)), sum);
      sum = mul_add(c, broadcast(M(k, 2)), sum);
      store(&out(row, k), sum);
    }
  }
}

/// out += P G^T over the leading columns of P; G dense, shape (3, columns).
inline void add_product(const MatX& P, const Eigen::Ref<const Rows3>& G, MatX3& out) {
  const Eigen::Index columns = G.cols(), stride = P.rows();
  for_lanes(P.rows(), [&]<int count>(std::size_t row) {
    Lanes sum[3][count];
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k)
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) sum[k][b] = load(&out(row + b * lane_width, k));
    const double* p = P.data() + row;
    const double *x = G.data(), *y = x + G.outerStride(), *z = y + G.outerStride();
    for (Eigen::Index j = 0; j < columns; ++j, p += stride) {
      const Lanes g0 = broadcast(x[j]), g1 = broadcast(y[j]), g2 = broadcast(z[j]);
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) {
        const Lanes pj = load(p + b * lane_width);
        sum[0][b] = mul_add(pj, g0, sum[0][b]);
        sum[1][b] = mul_add(pj, g1, sum[1][b]);
        sum[2][b] = mul_add(pj, g2, sum[2][b]);
      }
    }
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k)
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) store(&out(row + b * lane_width, k), sum[k][b]);
  });
}

/// out += sum of P(:, column) value over the entries: a scalar of the readout depends on few
/// parameters.
template <class Entry>
void add_sparse_product(const MatX& P, const Entry* entries, std::size_t n, double* out) {
  for_lanes(P.rows(), [&]<int count>(std::size_t row) {
    Lanes sum[count];
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b) sum[b] = load(out + row + b * lane_width);
    for (std::size_t k = 0; k < n; ++k) {
      const double* p = P.col(entries[k].column).data() + row;
      const Lanes h = broadcast(entries[k].value);
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) sum[b] = mul_add(load(p + b * lane_width), h, sum[b]);
    }
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b) store(out + row + b * lane_width, sum[b]);
  });
}

/// P -= U U^T, for one U or two at once. The products commute, so P stays symmetric bit by bit.
template <class... U>
void downdate(MatX& P, const U&... us) {
  constexpr int rank = 3 * sizeof...(U);
  const MatX3* all[] = {&us...};
  const Eigen::Index columns = P.cols(), stride = P.rows();
  const double* v[rank];
  for (int k = 0; k < rank; ++k) v[k] = all[k / 3]->col(k % 3).data();
  const auto block = [&]<int count>(std::size_t row) {
    Lanes u[rank][count];  // minus U, so that the broadcast below comes straight from memory
#pragma GCC unroll 6
    for (int k = 0; k < rank; ++k)
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b)
        u[k][b] = mul_add(load(v[k] + row + b * lane_width), broadcast(-1.0), broadcast(0.0));
    double* p = P.data() + row;
    for (Eigen::Index j = 0; j < columns; ++j, p += stride) {
      Lanes sum[count];
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) sum[b] = load(p + b * lane_width);
#pragma GCC unroll 6
      for (int k = 0; k < rank; ++k) {
        const Lanes vk = broadcast(v[k][j]);
#pragma GCC unroll 8
        for (int b = 0; b < count; ++b) sum[b] = mul_add(u[k][b], vk, sum[b]);
      }
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) store(p + b * lane_width, sum[b]);
    }
  };
  for_lanes<lanes_at_once / 2>(P.rows(), block);
}

/// G A for a tall A, shape (3, 3).
inline Mat3 small_product(const Eigen::Ref<const Rows3>& G, const MatX3& A) {
  const auto columns = static_cast<std::size_t>(G.cols());
  const std::size_t whole = columns / lane_width * lane_width;
  Lanes sum[9];
  for (Lanes& s : sum) s = broadcast(0.0);
  const double* g[] = {G.data(), G.data() + G.outerStride(), G.data() + 2 * G.outerStride()};
  const double* a[] = {A.col(0).data(), A.col(1).data(), A.col(2).data()};
  for (std::size_t c = 0; c < whole; c += lane_width)
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      const Lanes ak = load(a[k] + c);
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) sum[3 * k + i] = mul_add(load(g[i] + c), ak, sum[3 * k + i]);
    }
  Eigen::Matrix<double, lane_width, 9> partial;
#pragma GCC unroll 9
  for (int e = 0; e < 9; ++e) store(partial.col(e).data(), sum[e]);
  Mat3 out = partial.colwise().sum().reshaped(3, 3);
  for (std::size_t c = whole; c < columns; ++c)
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) out(i, k) += g[i][c] * a[k][c];
  return out;
}

}  // namespace drift
