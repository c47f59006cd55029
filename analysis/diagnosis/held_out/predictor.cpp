#include "analysis/diagnosis/held_out/predictor.hpp"

#include <cmath>
#include <numbers>

namespace drift::diagnosis {

Predictor::Predictor(const inference::LinearProblem& problem, const inference::NoiseModel& noise)
    : problem_(problem), noise_(noise) {
  if (inference::SumsByCell::can(noise)) sums_.emplace(problem, noise);
}

inference::Marginal Predictor::marginal(const std::vector<bool>& left_out,
                                        const std::vector<int>& with) const {
  if (sums_) return sums_->marginal(left_out, with);
  return inference::marginal_of(problem_.without(left_out), noise_, with);
}

Prediction Predictor::predict(const std::vector<bool>& intervals,
                              const std::vector<int>& with) const {
  const inference::Marginal all = marginal(std::vector<bool>(intervals.size(), false), with),
                            rest = marginal(intervals, with);
  const auto rows = static_cast<std::size_t>(all.rows - rest.rows);
  return {all.chi2 - rest.chi2,
          0.5 * (all.log_likelihood2() - rest.log_likelihood2()) -
              0.5 * static_cast<double>(rows) * std::log(2.0 * std::numbers::pi),
          rows};
}

inference::Projected Predictor::candidates_without(const std::vector<bool>& intervals) const {
  if (sums_) return sums_->candidates(intervals);
  return inference::Projector(problem_.without(intervals), noise_).candidates();
}

}  // namespace drift::diagnosis
