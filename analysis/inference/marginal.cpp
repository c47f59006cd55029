#include "analysis/inference/marginal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/inference/noise_filter.hpp"
#include "analysis/inference/white_sums.hpp"
#include "core/estimate/sequential/information.hpp"

namespace drift::inference {

double Marginal::log_likelihood2() const {
  const double v = -chi2 - log_det;
  return std::isfinite(v) ? v : -std::numeric_limits<double>::infinity();
}

MarginalLikelihood::MarginalLikelihood(const LinearProblem& problem, const std::vector<int>& with)
    : measured_(problem),
      parameters_(static_cast<std::size_t>(problem.theta.cols()) + with.size()),
      width_(Information::row_width(parameters_)),
      rows_(static_cast<std::size_t>(problem.rows()) * width_, 0.0) {
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(
      rows_.data(), problem.rows(), static_cast<Eigen::Index>(width_));
  const Eigen::Index n = problem.theta.cols(), beside = static_cast<Eigen::Index>(with.size());
  rows.leftCols(n) = problem.theta;
  if (beside > 0) rows.middleCols(n, beside) = problem.extra(Eigen::all, with);
  rows.col(n + beside) = problem.r0;
}

MarginalLikelihood::~MarginalLikelihood() = default;

Marginal MarginalLikelihood::at(const NoiseModel& noise) const {
  if (!noise.driven()) {
    std::call_once(
        once_, [&] { sums_ = std::make_unique<WhiteSums>(measured_, rows_, width_, parameters_); });
    return sums_->at(noise);
  }
  constexpr std::size_t at_once = 64;  // rows: they stay in the cache
  const NoiseFilter filter(measured_, noise);
  NoiseFilter::Columns columns = filter.begin(width_);
  Information information(parameters_, width_);
  std::vector<double> part(at_once * width_);
  const std::size_t all = rows_.size() / width_;
  for (std::size_t first = 0; first < all; first += at_once) {
    const std::size_t count = std::min(at_once, all - first);
    filter.whiten(columns, rows_.data() + first * width_, part.data(),
                  static_cast<Eigen::Index>(count));
    information.add(part.data(), count);
  }
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!information.factorise()) return {infinite, infinite, measured_.rows()};
  const VecX mean = VecX::Zero(static_cast<Eigen::Index>(parameters_));
  return {information.cost(information.solve(mean), mean), filter.log_det() + information.log_det(),
          measured_.rows()};
}

}  // namespace drift::inference
