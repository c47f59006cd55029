#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "analysis/inference/linear_problem.hpp"
#include "analysis/inference/noise/noise_model.hpp"

namespace drift::inference {

class WhiteSums;

/// Marginal (restricted) likelihood of all rows: parameters and attitudes integrated over their
/// priors, candidates absent.
struct Marginal {
  double chi2 = 0.0;     ///< r0' V^-1 r0, of `rows` degrees when the model is right
  double log_det = 0.0;  ///< of V, the marginal covariance of the rows: noise, attitude, parameters
  Eigen::Index rows = 0;
  /// Twice the log, without the constant; minus infinity where it is not finite.
  double log_likelihood2() const;
};

/// The marginal likelihood of one linearised test as a function of the noise.
class MarginalLikelihood {
 public:
  /// with: candidates whose columns are parameters too, a ~ N(0, I). `problem` must outlive this.
  explicit MarginalLikelihood(const LinearProblem& problem, const std::vector<int>& with = {});
  ~MarginalLikelihood();

  Marginal at(const NoiseModel& noise) const;
  double log_likelihood2(const NoiseModel& noise) const { return at(noise).log_likelihood2(); }
  const MeasuredRows& measured() const { return measured_; }

 private:
  const MeasuredRows& measured_;
  std::size_t parameters_, width_;
  std::vector<double> rows_;  ///< [parameters, r0, zeros] row after row
  mutable std::once_flag once_;
  mutable std::unique_ptr<WhiteSums> sums_;  ///< made when they are first asked for
};

inline Marginal marginal_of(const LinearProblem& problem, const NoiseModel& noise,
                            const std::vector<int>& with = {}) {
  return MarginalLikelihood(problem, with).at(noise);
}

}  // namespace drift::inference
