#include "core/estimate/sequential/information.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/estimate/lanes.hpp"

namespace drift {
namespace {

/// Rows of the sum that are worked out together, each beside a few lanes of columns.
constexpr std::size_t block = 4;

/// sum(4 rows from i on, `count` lanes of columns from c on) +- products of entry i of `rows` with
/// entry c of `beside`, over how many there are of each.
enum class Sign { plus, minus };
template <int count, Sign sign>
void add_tile(const double* rows, const double* beside, std::size_t how_many, std::size_t width,
              std::size_t i, std::size_t c, double* sum) {
  Lanes tile[block][count];
#pragma GCC unroll 4
  for (std::size_t a = 0; a < block; ++a)
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b)
      tile[a][b] = load(sum + (i + a) * width + c + static_cast<std::size_t>(b) * lane_width);
  const double* t = rows;
  const double* u = beside;
  for (std::size_t r = 0; r < how_many; ++r, t += width, u += width) {
    Lanes column[count];
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b)
      column[b] = load(u + c + static_cast<std::size_t>(b) * lane_width);
#pragma GCC unroll 4
    for (std::size_t a = 0; a < block; ++a) {
      const Lanes ta = broadcast(sign == Sign::plus ? t[i + a] : -t[i + a]);
#pragma GCC unroll 8
      for (int b = 0; b < count; ++b) tile[a][b] = mul_add(column[b], ta, tile[a][b]);
    }
  }
#pragma GCC unroll 4
  for (std::size_t a = 0; a < block; ++a)
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b)
      store(sum + (i + a) * width + c + static_cast<std::size_t>(b) * lane_width, tile[a][b]);
}

/// As many lanes of columns as are summed up side by side: of 32 registers 16 sums, 4 columns, a
/// number; of 16 registers 12, 3 and one.
constexpr std::size_t tile_lanes = lanes_at_once == 8 ? 4 : 3;

/// Calls body.template operator()<count>(c) for the columns from c on, in tiles of nearly equal
/// width: one of a single lane would wait for its own sums.
template <class Body>
void for_tiles(std::size_t c, std::size_t width, Body&& body) {
  for (std::size_t left = (width - c) / lane_width; left > 0;) {
    const std::size_t count = left >= 2 * tile_lanes ? tile_lanes
                              : left > tile_lanes    ? (left + 1) / 2
                                                     : left;
    switch (count) {
      case 1:
        body.template operator()<1>(c);
        break;
      case 2:
        body.template operator()<2>(c);
        break;
      case 3:
        body.template operator()<3>(c);
        break;
      default:
        body.template operator()<tile_lanes>(c);
    }
    c += count * lane_width;
    left -= count;
  }
}

/// The same for all columns from i on.
template <Sign sign>
void add_tiles(const double* rows, std::size_t how_many, std::size_t width, std::size_t i,
               double* sum) {
  for_tiles(i / lane_width * lane_width, width, [&]<int count>(std::size_t c) {
    add_tile<count, sign>(rows, rows, how_many, width, i, c, sum);
  });
}

/// Rows `first` to first + block - 1 of the factor, of which all that hangs on the rows before has
/// been taken off. False if some pivot is not positive and finite.
bool factorise_block(double* U, std::size_t first, std::size_t n, std::size_t width,
                     double* inverse_diagonal) {
  const std::size_t count = std::min(block, n - first);
  double* rows = U + first * width;
  double u[block][block] = {}, inverse[block] = {1.0, 1.0, 1.0, 1.0};
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a; b < count; ++b) u[a][b] = rows[a * width + first + b];
  for (std::size_t a = 0; a < count; ++a) {
    if (!(u[a][a] > 0.0) || !std::isfinite(u[a][a])) return false;
    inverse_diagonal[first + a] = inverse[a] = 1.0 / std::sqrt(u[a][a]);
    for (std::size_t b = a; b < count; ++b) u[a][b] *= inverse[a];
    for (std::size_t b = a + 1; b < count; ++b)
      for (std::size_t c = b; c < count; ++c) u[b][c] -= u[a][b] * u[a][c];
  }
  for (std::size_t c = first / lane_width * lane_width; c < width; c += lane_width) {
    Lanes r[block];
#pragma GCC unroll 4
    for (std::size_t a = 0; a < block; ++a) {
      r[a] = load(rows + a * width + c);
#pragma GCC unroll 4
      for (std::size_t b = 0; b < a; ++b) r[a] = mul_add(r[b], broadcast(-u[b][a]), r[a]);
      r[a] = mul_add(r[a], broadcast(inverse[a]), broadcast(0.0));
      store(rows + a * width + c, r[a]);
    }
  }
  // Whole lanes were written: what stands before the diagonal is no part of U.
  for (std::size_t a = 0; a < count; ++a)
    std::fill(rows + a * width + first / lane_width * lane_width, rows + a * width + first + a,
              0.0);
  return true;
}

}  // namespace

std::size_t Information::row_width(std::size_t parameters) {
  return whole_lanes((parameters + block) / block * block);
}

Information::Information(std::size_t parameters, std::size_t width)
    : n_(parameters),
      width_(width),
      sum_((width + block) * width, 0.0),
      factor_(sum_),
      work_(std::max(parameters, block) * width, 0.0),
      inverse_diagonal_(width, 1.0),
      solution_(VecX::Zero(static_cast<Eigen::Index>(n_))),
      turned_(solution_) {
  DRIFT_DEMAND(width == row_width(parameters));
  factorise();
}

void Information::clear() {
  std::ranges::fill(sum_, 0.0);
}

void Information::add(const double* rows, std::size_t count) {
  for (std::size_t i = 0; i <= n_; i += block)
    add_tiles<Sign::plus>(rows, count, width_, i, sum_.data());
}

double Information::product(const double* rows, const double* others, std::size_t count,
                            const MatX& P) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n_; i += block) {
    std::fill_n(work_.data(), block * width_, 0.0);
    for_tiles(0, width_, [&]<int lanes>(std::size_t c) {
      add_tile<lanes, Sign::plus>(rows + i, others, count, width_, 0, c, work_.data());
    });
    for (std::size_t a = 0; a < std::min(block, n_ - i); ++a)
      sum += P.col(static_cast<Eigen::Index>(i + a))
                 .dot(Eigen::Map<const VecX>(&work_[a * width_], P.rows()));
  }
  return sum;
}

bool Information::factorise() {
  double* U = factor_.data();
  for (std::size_t i = 0; i < n_; ++i) {
    std::copy_n(&sum_[i * width_], n_, U + i * width_);
    std::fill(U + i * width_ + n_, U + (i + 1) * width_, 0.0);
    U[i * width_ + i] += 1.0;
  }
  for (std::size_t i = n_; i < n_ + block; ++i) std::fill_n(U + i * width_, width_, 0.0);
  for (std::size_t first = 0; first < n_; first += block) {
    add_tiles<Sign::minus>(U, first, width_, first, U);
    if (!factorise_block(U, first, n_, width_, inverse_diagonal_.data())) return false;
  }
  return true;
}

const VecX& Information::solve(const VecX& prior) {
  const auto at = [](std::size_t k) { return static_cast<Eigen::Index>(k); };
  for (std::size_t k = 0; k < n_; ++k) solution_[at(k)] = prior[at(k)] + sum_[k * width_ + n_];
  const auto n = at(n_);
  for (std::size_t k = 0; k < n_; ++k) {  // U^T y = b
    const double y = solution_[at(k)] *= inverse_diagonal_[k];
    solution_.tail(n - at(k) - 1) -= y * Eigen::Map<const VecX>(factor(k) + k + 1, n - at(k) - 1);
  }
  for (std::size_t k = n_; k-- > 0;)  // U x = y
    solution_[at(k)] =
        (solution_[at(k)] - solution_.tail(n - at(k) - 1)
                                .dot(Eigen::Map<const VecX>(factor(k) + k + 1, n - at(k) - 1))) *
        inverse_diagonal_[k];
  return solution_;
}

double Information::cost(const VecX& x, const VecX& prior) const {
  double right = 0.0;
  for (std::size_t k = 0; k < n_; ++k)
    right += x[static_cast<Eigen::Index>(k)] *
             (sum_[k * width_ + n_] + prior[static_cast<Eigen::Index>(k)]);
  return sum_[n_ * width_ + n_] + prior.squaredNorm() - right;
}

double Information::log_det() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < n_; ++k) sum -= std::log(inverse_diagonal_[k]);
  return 2.0 * sum;
}

void Information::whiten(double* rows, std::size_t count) const {
  // A few rows side by side, by the columns of a lane: those first, then what they do to the rest.
  constexpr std::size_t beside = 4;
  const auto whiten_some = [&]<std::size_t how_many>(double* first) {
    for (std::size_t k = 0; k < n_; k += lane_width) {
      const std::size_t end = std::min(k + lane_width, n_);
      double minus[how_many][lane_width] = {};
      for (std::size_t a = 0; a < how_many; ++a)
        for (std::size_t i = k; i < end; ++i) {
          double x = first[a * width_ + i];
          for (std::size_t j = k; j < i; ++j) x += factor(j)[i] * minus[a][j - k];
          x *= inverse_diagonal_[i];
          first[a * width_ + i] = x;
          minus[a][i - k] = -x;
        }
      for (std::size_t c = k + lane_width; c < n_; c += lane_width) {
        Lanes sum[how_many];
        for (std::size_t a = 0; a < how_many; ++a) sum[a] = load(first + a * width_ + c);
#pragma GCC unroll 8
        for (std::size_t j = 0; j < lane_width; ++j) {
          const Lanes u = load(factor(k + j) + c);
#pragma GCC unroll 4
          for (std::size_t a = 0; a < how_many; ++a)
            sum[a] = mul_add(u, broadcast(minus[a][j]), sum[a]);
        }
        for (std::size_t a = 0; a < how_many; ++a) store(first + a * width_ + c, sum[a]);
      }
    }
  };
  std::size_t r = 0;
  for (; r + beside <= count; r += beside)
    whiten_some.template operator()<beside>(rows + r * width_);
  for (; r < count; ++r) whiten_some.template operator()<1>(rows + r * width_);
}

double Information::variance_of(const double* t) {
  if (n_ == 0) return 0.0;
  std::copy_n(t, n_, work_.data());
  std::fill_n(work_.data() + n_, width_ - n_, 0.0);
  whiten(work_.data(), 1);
  return Eigen::Map<const VecX>(work_.data(), static_cast<Eigen::Index>(n_)).squaredNorm();
}

const VecX& Information::whitened(const VecX& d) {
  const auto n = static_cast<Eigen::Index>(n_);
  for (Eigen::Index k = 0; k < n; ++k)
    turned_[k] =
        d.tail(n - k).dot(Eigen::Map<const VecX>(factor(static_cast<std::size_t>(k)) + k, n - k));
  return turned_;
}

void Information::invert(MatX& P) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n = static_cast<Eigen::Index>(n_), wide = static_cast<Eigen::Index>(width_);
  Eigen::Map<Rows> rows(work_.data(), n, wide);
  rows.setIdentity();
  whiten(work_.data(), n_);  // rows of U^-1
  P.setZero();
  P.selfadjointView<Eigen::Lower>().rankUpdate(rows.leftCols(n));
  P.triangularView<Eigen::StrictlyUpper>() = P.transpose();
}

}  // namespace drift
