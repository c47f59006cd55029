#include "analysis/strapdown/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/base/rng.hpp"

namespace drift::strapdown {
namespace {

constexpr int resamples = 1000;
constexpr std::uint32_t bootstrap_stream = 1;  // 0 divides the dwells into parts

}  // namespace

double root_mean_square(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double e : errors) sum += e * e;
  return errors.empty() ? nan_value : std::sqrt(sum / static_cast<double>(errors.size()));
}

Score score_of(const std::vector<double>& in_sample, const std::vector<double>& held_out,
               double unit, std::uint64_t seed) {
  Score score{.count = held_out.size(),
              .in_sample = root_mean_square(in_sample) / unit,
              .held_out = root_mean_square(held_out) / unit,
              .low = nan_value,
              .high = nan_value,
              .median = nan_value,
              .errors = held_out};
  for (double& e : score.errors) e /= unit;
  // A model that cannot predict (NaN) has no order statistics either.
  if (score.errors.empty() || !std::isfinite(score.held_out)) return score;
  Stream stream(seed, 0, Purpose::design, bootstrap_stream);
  std::vector<double> means(resamples);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::size_t k = 0; k < score.count; ++k) {
      const auto pick =
          static_cast<std::size_t>(stream.uniform() * static_cast<double>(score.count));
      sum += score.errors[pick] * score.errors[pick];
    }
    mean = sum / static_cast<double>(score.count);
  }
  std::sort(means.begin(), means.end());
  score.low = std::sqrt(means[resamples * 25 / 1000]);
  score.high = std::sqrt(means[resamples * 975 / 1000 - 1]);
  std::vector<double> ordered = score.errors;
  std::sort(ordered.begin(), ordered.end());
  score.median = 0.5 * (ordered[(score.count - 1) / 2] + ordered[score.count / 2]);
  return score;
}

double paired_gain(const std::vector<double>& before, const std::vector<double>& after) {
  DRIFT_DEMAND(before.size() == after.size());
  const double n = static_cast<double>(before.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) sum += before[k] - after[k];
  for (std::size_t k = 0; k < before.size(); ++k)
    squares += std::pow(before[k] - after[k] - sum / n, 2);
  if (sum == 0.0 && squares == 0.0) return 0.0;
  return sum / n / std::sqrt(squares / (n - 1.0) / n);
}

}  // namespace drift::strapdown
