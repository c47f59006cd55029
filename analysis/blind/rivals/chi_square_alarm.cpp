#include <array>
#include <cmath>

#include "analysis/blind/rivals/rival.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::blind {
namespace {

/// Ljung and Box (1978): n (n + 2) sum_k r_k^2 / (n - k), chi-square of `lags` degrees.
double ljung_box(const std::vector<double>& z, int lags) {
  const auto n = static_cast<double>(z.size());
  double square = 0.0, sum = 0.0;
  for (const double v : z) square += v * v;
  if (!(square > 0.0)) return 0.0;
  for (int k = 1; k <= lags && static_cast<std::size_t>(k) < z.size(); ++k) {
    double product = 0.0;
    for (std::size_t i = static_cast<std::size_t>(k); i < z.size(); ++i)
      product += z[i] * z[i - static_cast<std::size_t>(k)];
    sum += product * product / (square * square) / (n - k);
  }
  return n * (n + 2.0) * sum;
}

}  // namespace

RivalAnswer chi_square_alarm(const RivalTest& test, double alpha) {
  constexpr int lags = 10;
  const search::Fitted& e = test.examined;
  const double log_chi2 =
      stats::log_tail(e.fit.estimate.statistic, static_cast<double>(e.fit.estimate.measured));
  const VecX residual = inference::residual_of(e.problem, e.fit);
  std::array<std::vector<double>, inference::num_channels> channels;
  for (Eigen::Index k = 0; k < residual.size(); ++k)
    channels[static_cast<std::size_t>(e.problem.tags[static_cast<std::size_t>(k)].channel)]
        .push_back(residual[k]);
  double log_box = 0.0;
  for (const auto& z : channels)
    if (!z.empty()) log_box = std::min(log_box, stats::log_tail(ljung_box(z, lags), lags));
  RivalAnswer out;
  out.alarm =
      log_chi2 < std::log(0.5 * alpha) || log_box < std::log(0.5 * alpha / inference::num_channels);
  return out;
}

}  // namespace drift::blind
