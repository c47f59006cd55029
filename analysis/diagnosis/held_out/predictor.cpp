#include "analysis/diagnosis/held_out/predictor.hpp"

#include <cmath>
#include <numbers>

namespace drift::diagnosis {

Predictor::Predictor(const inference::LinearProblem& problem, const inference::NoiseModel& noise)
    : problem_(problem.bare()),
      noise_(noise),
      all_(inference::Projector(problem_, noise_).marginal()) {}

Prediction Predictor::predict(const std::vector<bool>& intervals) const {
  const inference::Marginal rest =
      inference::Projector(problem_.without(intervals), noise_).marginal();
  const auto rows = static_cast<std::size_t>(all_.rows - rest.rows);
  return {all_.chi2 - rest.chi2,
          0.5 * (all_.log_likelihood2() - rest.log_likelihood2()) -
              0.5 * static_cast<double>(rows) * std::log(2.0 * std::numbers::pi),
          rows};
}

}  // namespace drift::diagnosis
