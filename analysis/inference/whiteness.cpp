#include "analysis/inference/whiteness.hpp"

#include <algorithm>
#include <map>

#include "core/base/normal_draws.hpp"

namespace drift::inference {
namespace {

/// Rows of one channel, chain after chain, in time order.
struct ChannelRows {
  std::vector<std::vector<Eigen::Index>> chains;
};

std::vector<ChannelRows> rows_by_channel(const MeasuredRows& problem) {
  std::map<int, std::map<int, std::vector<Eigen::Index>>> sorted;  // channel, chain
  for (Eigen::Index k = 0; k < problem.rows(); ++k) {
    const RowTag& t = problem.tags[k];
    sorted[t.channel][problem.drives[t.interval].chain].push_back(k);
  }
  std::vector<ChannelRows> all;
  for (auto& [channel, chains] : sorted) {
    all.emplace_back();
    for (auto& [chain, rows] : chains) all.back().chains.push_back(std::move(rows));
  }
  return all;
}

/// Largest Q of the channels, for each column of z.
VecX largest_Q(const std::vector<ChannelRows>& channels, const MatX& z, int lags) {
  VecX largest = VecX::Zero(z.cols());
  for (const ChannelRows& channel : channels)
    for (Eigen::Index j = 0; j < z.cols(); ++j) {
      const double* const v = z.col(j).data();
      double square = 0.0, Q = 0.0;
      for (const auto& rows : channel.chains)
        for (const Eigen::Index k : rows) square += v[k] * v[k];
      if (!(square > 0.0)) continue;
      for (int lag = 1; lag <= lags; ++lag) {
        double sum = 0.0, pairs = 0.0;
        for (const auto& rows : channel.chains) {
          if (rows.size() <= static_cast<std::size_t>(lag)) continue;
          const std::size_t n = rows.size() - static_cast<std::size_t>(lag);
          for (std::size_t t = 0; t < n; ++t)
            sum += v[rows[t]] * v[rows[t + static_cast<std::size_t>(lag)]];
          pairs += static_cast<double>(n);
        }
        if (pairs == 0.0) break;
        double count = 0.0;
        for (const auto& rows : channel.chains) count += static_cast<double>(rows.size());
        const double mean_square = square / count, r = sum / pairs / mean_square;
        Q += pairs * r * r;
      }
      largest[j] = std::max(largest[j], Q);
    }
  return largest;
}

}  // namespace

double whiteness_p(const MeasuredRows& problem, const Projector& projector, int lags, int draws,
                   std::uint64_t seed) {
  if (problem.rows() == 0 || draws <= 0) return 1.0;
  const auto channels = rows_by_channel(problem);
  const double observed = largest_Q(channels, projector.clean_residual(), lags)[0];
  constexpr int at_once = 50;  // columns
  int above = 0;
  for (int first = 0; first < draws; first += at_once) {
    const int count = std::min(at_once, draws - first);
    MatX z(problem.rows(), count), x(projector.theta().cols(), count);
    for (int j = 0; j < count; ++j) {
      NormalDraws normal(seed, static_cast<std::uint64_t>(first + j));
      for (Eigen::Index k = 0; k < z.rows(); ++k) z(k, j) = normal();
      for (Eigen::Index k = 0; k < x.rows(); ++k) x(k, j) = normal();
    }
    z.noalias() += projector.theta() * x;
    const VecX drawn = largest_Q(channels, projector.clean(z), lags);
    above += static_cast<int>((drawn.array() >= observed).count());
  }
  return (1.0 + above) / (1.0 + draws);
}

}  // namespace drift::inference
