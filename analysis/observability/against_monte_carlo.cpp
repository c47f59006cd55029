#include "analysis/observability/against_monte_carlo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/observability/other_methods.hpp"

namespace drift::observability {
namespace {

constexpr double tolerance = 0.1;  // of the promise: what linearisation may cost without a word
/// A start drawn from the prior beside a truth drawn from it doubles the variance of what stays
/// unlearned: beyond that the prior explains nothing.
constexpr double prior_excess = std::numbers::sqrt2 * (1.0 + tolerance);

/// sigma_ratio: the sigma that the filter reports over the prior's.
void judge(ErrorComparison& c, TruthIs truth, ProcessNoiseIs noise, double sigma_ratio) {
  if (!std::isfinite(c.low) || !std::isfinite(c.high)) return;
  const double promise = c.learning_ratio;
  const bool holds = c.low <= promise * (1.0 + tolerance) && c.high >= promise * (1.0 - tolerance);
  const bool prior_rules = promise * promise >= 0.5;
  if (prior_rules && c.low <= prior_excess) {
    c.verdict = ErrorVerdict::prior_dominated;
    c.reason = fmt::format(
        "the data leave {:.0f} % of the prior sigma: the error shows how truth and starts "
        "were drawn",
        100.0 * promise);
  } else if (holds) {
    c.verdict = ErrorVerdict::agree;
  } else if (noise == ProcessNoiseIs::there &&
             (truth == TruthIs::the_model || c.rmse_ratio <= sigma_ratio)) {
    c.verdict = ErrorVerdict::process_noise;
    c.reason = fmt::format(
        "{:.3g} times the promised sigma: the process noise is another than the filter allows for",
        c.rmse_ratio / promise);
  } else if (c.low <= sigma_ratio * (1.0 + tolerance) &&
             c.high >= sigma_ratio * (1.0 - tolerance)) {
    c.verdict = ErrorVerdict::nonlinear;
    c.reason = fmt::format(
        "{:.3g} times the promised sigma, as the filter itself says: its levers depend on where "
        "the truth lies",
        c.rmse_ratio / promise);
  } else if (truth == TruthIs::another_model && c.rmse_ratio > sigma_ratio) {
    c.verdict = ErrorVerdict::wrong_model;
    c.reason = fmt::format(
        "{:.3g} times the sigma that the filter reports: the data come from another model",
        c.rmse_ratio / sigma_ratio);
  } else {
    c.verdict = ErrorVerdict::nonlinear;
    c.reason = fmt::format(
        "{:.3g} times the promised sigma: levers depend on where the truth lies, or the "
        "estimator is linearised elsewhere",
        c.rmse_ratio / promise);
  }
}

}  // namespace

std::string_view text_of(ErrorVerdict verdict) {
  switch (verdict) {
    case ErrorVerdict::undecided:
      return "undecided";
    case ErrorVerdict::agree:
      return "agree";
    case ErrorVerdict::nonlinear:
      return "nonlinear";
    case ErrorVerdict::wrong_model:
      return "wrong model";
    case ErrorVerdict::process_noise:
      return "process noise";
    case ErrorVerdict::prior_dominated:
      return "prior dominated";
  }
  return "";
}

std::size_t MonteCarloComparison::count(ErrorVerdict verdict) const {
  return static_cast<std::size_t>(
      std::ranges::count(parameters, verdict, [](const ErrorComparison& c) { return c.verdict; }));
}

MonteCarloComparison compare_with_monte_carlo(const Ranking& ranking,
                                              std::span<const MonteCarloError> errors,
                                              TruthIs truth, ProcessNoiseIs noise) {
  MonteCarloComparison out;
  for (const std::size_t state : ranking.order) {
    const ParameterRank& p = ranking.parameters[state];
    const auto error = std::ranges::find(errors, p.param, &MonteCarloError::param);
    if (error == errors.end() || !std::isfinite(error->rmse)) continue;
    ErrorComparison c;
    c.param = p.param;
    c.learning_ratio = p.learning_ratio();
    c.rmse_ratio = error->rmse / p.prior_sigma;
    c.low = error->low / p.prior_sigma;
    c.high = error->high / p.prior_sigma;
    judge(c, truth, noise, error->sigma / p.prior_sigma);
    out.parameters.push_back(std::move(c));
  }
  const auto n = static_cast<Eigen::Index>(out.parameters.size());
  VecX promised(n), found(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    promised[k] = -out.parameters[k].learning_ratio;
    found[k] = -out.parameters[k].rmse_ratio;
  }
  const VecX rank_promised = ranks_of(promised), rank_found = ranks_of(found);
  for (Eigen::Index k = 0; k < n; ++k) {
    out.parameters[k].rank_promised = rank_promised[k];
    out.parameters[k].rank_found = rank_found[k];
  }
  out.spearman = spearman(promised, found);
  return out;
}

}  // namespace drift::observability
