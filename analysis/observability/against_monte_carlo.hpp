#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/observability/ranking.hpp"

namespace drift::observability {

/// What a Monte Carlo study found of one parameter: root mean square error of the estimates, with
/// its interval (NaN: there is none), and the sigma that the filter reported (root mean square),
/// SI.
struct MonteCarloError {
  std::size_t param = 0;  ///< index in TermLibrary
  double rmse = 0.0, low = 0.0, high = 0.0;
  double sigma = 0.0;
};

/// Whether the data of the study came from the model that is ranked.
enum class TruthIs { the_model, another_model };

/// Whether the truth has process noise other than what the filter allows for.
enum class ProcessNoiseIs { nowhere, there };

/// How an error of the study stands to what the information promises.
enum class ErrorVerdict {
  undecided,      ///< there is no interval: one run
  agree,          ///< the interval holds the promise (within 10 %)
  nonlinear,      ///< another error, which the filter knows of, or of the same model: levers depend
                  ///< on where the truth lies, or the estimator is not efficient
  wrong_model,    ///< another model made the data, and the error is beyond what the filter claims
  process_noise,  ///< another error, where the truth has process noise other than the filter's
  prior_dominated,  ///< the prior says at least as much as the data: the error shows how truth and
                    ///< starts were drawn
};
/// "undecided", "agree", "nonlinear", "wrong model", "process noise", "prior dominated".
std::string_view text_of(ErrorVerdict verdict);

/// One parameter, by both methods.
struct ErrorComparison {
  std::size_t param = 0;
  double learning_ratio = 0.0;                     ///< promised: posterior / prior sigma
  double rmse_ratio = 0.0, low = 0.0, high = 0.0;  ///< found: RMSE / prior sigma and its interval
  double rank_promised = 0.0, rank_found = 0.0;    ///< 1 = best known; ties share their mean
  ErrorVerdict verdict = ErrorVerdict::undecided;
  std::string reason;  ///< in words; empty if they agree
};

/// The two rankings side by side.
struct MonteCarloComparison {
  std::vector<ErrorComparison> parameters;  ///< by rising learning ratio
  double spearman = 0.0;  ///< rank correlation; NaN with fewer than two parameters
  std::size_t count(ErrorVerdict verdict) const;
};

/// Puts errors of a study beside the ranking of its plan. Parameters that the ranking does not have
/// are left out, as are those whose RMSE is not finite.
MonteCarloComparison compare_with_monte_carlo(const Ranking& ranking,
                                              std::span<const MonteCarloError> errors,
                                              TruthIs truth,
                                              ProcessNoiseIs noise = ProcessNoiseIs::nowhere);

}  // namespace drift::observability
