#pragma once

#include "analysis/inference/projector.hpp"

namespace drift::diagnosis {

/// How well rows that were held out are predicted from the others.
struct Prediction {
  double chi2 = 0.0, log_score = 0.0;  ///< log score: log predictive density
  std::size_t rows = 0;
};

/// A linearised test that predicts a part of its rows from all the others, parameters and attitudes
/// marginalised: log p(y_p | y_rest) = log p(y) - log p(y_rest), chi-square likewise. Candidates
/// are left out.
class Predictor {
 public:
  Predictor(const inference::LinearProblem& problem, const inference::NoiseModel& noise);

  /// The rows of the intervals that are marked.
  Prediction predict(const std::vector<bool>& intervals) const;

 private:
  inference::LinearProblem problem_;
  inference::NoiseModel noise_;
  inference::Marginal all_;
};

}  // namespace drift::diagnosis
