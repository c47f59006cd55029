#pragma once

#include <optional>

#include "analysis/inference/sums_by_cell.hpp"

namespace drift::diagnosis {

/// How well rows that were held out are predicted from the others.
struct Prediction {
  double chi2 = 0.0, log_score = 0.0;  ///< log score: log predictive density
  std::size_t rows = 0;
};

/// A linearised test that predicts a part of its rows from all the others, parameters and attitudes
/// marginalised: log p(y_p | y_rest) = log p(y) - log p(y_rest), chi-square likewise.
class Predictor {
 public:
  /// The problem must outlive it.
  Predictor(const inference::LinearProblem& problem, const inference::NoiseModel& noise);

  /// The rows of the intervals that are marked, whole positions. with: candidates that are
  /// parameters too; the others are left out.
  Prediction predict(const std::vector<bool>& intervals, const std::vector<int>& with = {}) const;
  /// What the others say of the candidates.
  inference::Projected candidates_without(const std::vector<bool>& intervals) const;

 private:
  inference::Marginal marginal(const std::vector<bool>& left_out,
                               const std::vector<int>& with) const;

  const inference::LinearProblem& problem_;
  inference::NoiseModel noise_;
  std::optional<inference::SumsByCell> sums_;  ///< where the noise allows them
};

}  // namespace drift::diagnosis
