#include "analysis/inference/sums_by_cell.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/check.hpp"
#include "core/base/decompose.hpp"
#include "core/sim/measurements.hpp"

namespace drift::inference {
namespace {

/// [psi, theta, extra, r0] of some rows, over the sigma of each; its log is added to log_det.
MatX scaled_rows(const LinearProblem& p, const NoiseModel& noise,
                 const std::vector<Eigen::Index>& rows, double& log_det) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  const Eigen::Index n = p.theta.cols(), extra = p.extra.cols();
  VecX weight(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::Index row = rows[static_cast<std::size_t>(k)];
    const bool accelerometer = p.tags[static_cast<std::size_t>(row)].accelerometer();
    weight[k] = p.weight[row] / (accelerometer ? noise.acc_factor : noise.gimbal_factor);
    log_det -= 2.0 * std::log(weight[k]);
  }
  MatX all(count, 3 + n + extra + 1);
  all.leftCols<3>() = p.psi(rows, Eigen::all);
  all.middleCols(3, n) = p.theta(rows, Eigen::all);
  all.middleCols(3 + n, extra) = p.extra(rows, Eigen::all);
  all.rightCols<1>() = p.r0(rows);
  return weight.asDiagonal() * all;
}

}  // namespace

SumsByCell::SumsByCell(const LinearProblem& problem, const NoiseModel& noise)
    : n_(problem.theta.cols()), extra_(problem.extra.cols()) {
  DRIFT_EXPECTS(can(noise));
  std::map<std::pair<int, int>, std::vector<Eigen::Index>> rows_of;
  for (Eigen::Index k = 0; k < problem.rows(); ++k) {
    const RowTag& tag = problem.tags[static_cast<std::size_t>(k)];
    rows_of[{problem.drives[tag.interval].chain, tag.position}].push_back(k);
  }
  for (const auto& [key, rows] : rows_of) {
    Cell cell;
    cell.chain = key.first;
    for (const Eigen::Index k : rows) {
      const std::size_t i = problem.tags[static_cast<std::size_t>(k)].interval;
      if (cell.intervals.empty() || cell.intervals.back() != i) cell.intervals.push_back(i);
    }
    cell.rows = static_cast<Eigen::Index>(rows.size());
    const MatX columns = scaled_rows(problem, noise, rows, cell.log_det);
    cell.products = MatX::Zero(columns.cols(), columns.cols());
    cell.products.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
    cells_.push_back(std::move(cell));
  }
}

SumsByCell::Sum SumsByCell::sum_without(const std::vector<bool>& left_out) const {
  const Eigen::Index width = n_ + extra_ + 1;
  Sum sum{MatX::Zero(width, width), 0.0, 0};
  Mat3 on_attitude = Mat3::Identity();  // of the chain that is being added up
  MatX beside = MatX::Zero(width, 3);
  const auto eliminate = [&] {
    const Eigen::LLT<Mat3> root(on_attitude);
    const Mat3X half = root.matrixL().solve(beside.transpose());
    sum.products.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose(), -1.0);
    sum.log_det += 2.0 * root.matrixLLT().diagonal().array().log().sum();
    on_attitude.setIdentity();
    beside.setZero();
  };
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Cell& cell = cells_[c];
    const auto marked = std::ranges::count_if(
        cell.intervals, [&](std::size_t i) { return i < left_out.size() && left_out[i]; });
    DRIFT_EXPECTS(marked == 0 || marked == std::ssize(cell.intervals));
    if (marked == 0) {
      sum.products.triangularView<Eigen::Lower>() += cell.products.bottomRightCorner(width, width);
      on_attitude += Mat3(cell.products.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>());
      beside += cell.products.bottomLeftCorner(width, 3);
      sum.log_det += cell.log_det;
      sum.rows += cell.rows;
    }
    if (c + 1 == cells_.size() || cells_[c + 1].chain != cell.chain) eliminate();
  }
  return sum;
}

Marginal SumsByCell::marginal(const std::vector<bool>& left_out,
                              const std::vector<int>& with) const {
  const Sum sum = sum_without(left_out);
  const MatX products = sum.products.selfadjointView<Eigen::Lower>();
  std::vector<Eigen::Index> in(static_cast<std::size_t>(n_));
  std::iota(in.begin(), in.end(), 0);
  for (const int k : with) in.push_back(n_ + k);
  MatX A = products(in, in);
  A.diagonal().array() += 1.0;
  const Cholesky root(A);
  const VecX half = root.halved(products(in, products.cols() - 1));
  return {products(products.rows() - 1, products.cols() - 1) - half.squaredNorm(),
          sum.log_det + 2.0 * root.L().diagonal().array().log().sum(), sum.rows};
}

Projected SumsByCell::candidates(const std::vector<bool>& left_out) const {
  const Sum sum = sum_without(left_out);
  MatX A = sum.products.topLeftCorner(n_, n_);
  A.diagonal().array() += 1.0;
  const MatX half = Cholesky(A).halved(sum.products.bottomLeftCorner(extra_ + 1, n_).transpose());
  MatX left = sum.products.bottomRightCorner(extra_ + 1, extra_ + 1);
  const VecX raw = left.diagonal().head(extra_);
  left.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose(), -1.0);
  const MatX all = left.selfadjointView<Eigen::Lower>();
  return {all.topLeftCorner(extra_, extra_), all.col(extra_).head(extra_), raw};
}

}  // namespace drift::inference
