#include "core/estimate/information.hpp"

#include <algorithm>

#include "core/estimate/lanes.hpp"

namespace drift {
namespace {

/// Rows of the sum that are worked out together, one lane each beside the columns.
constexpr std::size_t block = 4;

/// sum(4 rows from i on, `count` lanes of columns from c on) += their products over the rows.
template <int count>
void add_tile(const double* rows, std::size_t how_many, std::size_t width, std::size_t i,
              std::size_t c, double* sum) {
  Lanes tile[block][count];
#pragma GCC unroll 4
  for (std::size_t a = 0; a < block; ++a)
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b)
      tile[a][b] = load(sum + (i + a) * width + c + static_cast<std::size_t>(b) * lane_width);
  const double* t = rows;
  for (std::size_t r = 0; r < how_many; ++r, t += width) {
    Lanes column[count];
#pragma GCC unroll 8
    for (int b = 0; b < count; ++b)
      column[b] = load(t + c + static_cast<std::size_t>(b) * lane_width);
#pragma GCC unroll 4
    for (std::size_t a = 0; a < block; ++a) {
      const Lanes ta = broadcast(t[i + a]);
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

}  // namespace

Information::Information(std::size_t parameters, std::size_t width)
    : n_(parameters),
      width_(width),
      sum_((width + block) * width, 0.0),
      matrix_(MatX::Zero(static_cast<Eigen::Index>(n_), static_cast<Eigen::Index>(n_))),
      solution_(VecX::Zero(matrix_.rows())),
      work_(matrix_.rows(), 2),
      factor_(static_cast<Eigen::Index>(n_)) {
  factor_.compute(MatX::Identity(matrix_.rows(), matrix_.cols()));
}

void Information::clear() {
  std::fill(sum_.begin(), sum_.end(), 0.0);
}

void Information::add(const double* rows, std::size_t count) {
  constexpr int at_once = 3;  // of 16 registers: 12 sums, 3 columns, a number
  for (std::size_t i = 0; i <= n_; i += block) {
    std::size_t c = i / lane_width * lane_width;
    for (; c + at_once * lane_width <= width_; c += at_once * lane_width)
      add_tile<at_once>(rows, count, width_, i, c, sum_.data());
    for (; c < width_; c += lane_width) add_tile<1>(rows, count, width_, i, c, sum_.data());
  }
}

bool Information::factorise() {
  for (std::size_t i = 0; i < n_; ++i) {
    for (std::size_t k = i; k < n_; ++k)
      matrix_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = sum_[i * width_ + k];
    matrix_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += 1.0;
  }
  factor_.compute(matrix_.selfadjointView<Eigen::Lower>());
  return factor_.info() == Eigen::Success && factor_.matrixLLT().diagonal().allFinite();
}

const VecX& Information::solve(const VecX& prior) {
  solution_ = prior;
  for (std::size_t k = 0; k < n_; ++k)
    solution_[static_cast<Eigen::Index>(k)] += sum_[k * width_ + n_];
  factor_.solveInPlace(solution_);
  return solution_;
}

double Information::length_squared(const VecX& d) const {
  work_.col(0) = d;
  work_.col(1).noalias() = factor_.matrixU() * d;
  return work_.col(1).squaredNorm();
}

double Information::covariance_of(const double* u, const double* t) const {
  const auto n = static_cast<Eigen::Index>(n_);
  work_.col(0) = Eigen::Map<const VecX>(u, n);
  work_.col(1) = Eigen::Map<const VecX>(t, n);
  factor_.matrixL().solveInPlace(work_);
  return work_.col(0).dot(work_.col(1));
}

double Information::variance_of(const double* t) const {
  return covariance_of(t, t);
}

void Information::invert(MatX& P) const {
  P.setIdentity();
  factor_.solveInPlace(P);
}

double Information::cost(const VecX& x, const VecX& prior) const {
  double right = 0.0;
  for (std::size_t k = 0; k < n_; ++k)
    right += x[static_cast<Eigen::Index>(k)] *
             (sum_[k * width_ + n_] + prior[static_cast<Eigen::Index>(k)]);
  return sum_[n_ * width_ + n_] + prior.squaredNorm() - right;
}

}  // namespace drift
