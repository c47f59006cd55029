#include "core/stats/allan_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/stats/allan.hpp"
#include "core/stats/lag_sum.hpp"

namespace drift::stats {
namespace {

constexpr double second_difference[3] = {1.0, -2.0, 1.0};  // its weights

/// A pair of averaging counts, and what follows from it alone.
struct Pair {
  double m1, m2;
  std::array<double, 9> kinks;  ///< lags at which two ends of differences meet
  double first, last;           ///< of them

  Pair(std::size_t a, std::size_t b) : m1(static_cast<double>(a)), m2(static_cast<double>(b)) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) kinks[3 * i + j] = j * m2 - i * m1;
    first = -2.0 * m1;
    last = 2.0 * m2;
  }
};

/// Covariance of z1(k) and z2(k - lag) for each random noise of unit coefficient.
Eigen::Vector4d covariance(const Pair& p, double lag) {
  Eigen::Vector4d c = Eigen::Vector4d::Zero();
  const bool touch = lag >= p.first && lag <= p.last;  // beyond, only flicker remembers
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double t = std::abs(lag - p.kinks[3 * i + j]),
                   w = second_difference[i] * second_difference[j];
      if (t > 0.0) c[2] += w * t * t * std::log(t) / (2.0 * std::numbers::pi);
      if (!touch) continue;
      if (t == 0.0) c[0] += w;
      c[1] -= 0.5 * w * t;
      c[3] += w * t * t * t / 12.0;
    }
  return c / (2.0 * p.m1 * p.m2);
}

/// How many pairs of places, over all stretches, are `lag` apart.
double pairs_at(double lag, std::span<const std::size_t> lengths, std::size_t m1, std::size_t m2) {
  double sum = 0.0;
  for (const std::size_t length : lengths) {
    const double n1 = static_cast<double>(places(length, m1)),
                 n2 = static_cast<double>(places(length, m2));
    sum += std::max(0.0, std::min(n1, n2 + lag) - std::max(0.0, lag));
  }
  return sum;
}

double all_places(std::span<const std::size_t> lengths, std::size_t count) {
  double sum = 0.0;
  for (const std::size_t length : lengths) sum += static_cast<double>(places(length, count));
  return sum;
}

/// Lags where the covariance or the number of pairs bends, and the ends of what counts: beyond,
/// flicker has fallen to the square of its distance, and less than a millionth of the sum is left.
std::vector<double> bends(const Pair& p, double longest1, double longest2) {
  constexpr double far = 50.0;
  const double low = std::max(-longest2, p.first - far * (p.m1 + p.m2));
  const double high = std::min(longest1, p.last + far * (p.m1 + p.m2));
  std::vector<double> at{low, high};
  for (const double kink : p.kinks) at.push_back(kink);
  at.push_back(0.0);
  at.push_back(2.0 * (p.m2 - p.m1));
  std::erase_if(at, [&](double lag) { return lag < low || lag > high; });
  std::ranges::sort(at);
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

}  // namespace

AllanSquares allan_slopes(double tau) {
  return {3.0 / (tau * tau), 1.0 / tau, 2.0 * std::numbers::ln2 / std::numbers::pi, tau / 3.0,
          0.5 * tau * tau};
}

AllanCovariance::AllanCovariance(std::span<const std::size_t> lengths,
                                 std::span<const std::size_t> counts, Pairs pairs)
    : size_(static_cast<Eigen::Index>(counts.size())) {
  for (int a = 0; a < random; ++a) {
    with_ramp_[a] = Eigen::MatrixXd::Zero(size_, size_);
    for (int b = a; b < random; ++b) products_[a][b] = Eigen::MatrixXd::Zero(size_, size_);
  }
  for (Eigen::Index i = 0; i < size_; ++i)
    for (Eigen::Index j = pairs == Pairs::all ? 0 : i; j <= i; ++j) add_pair(lengths, counts, i, j);
}

void AllanCovariance::add_pair(std::span<const std::size_t> lengths,
                               std::span<const std::size_t> counts, Eigen::Index i,
                               Eigen::Index j) {
  const std::size_t m1 = counts[i], m2 = counts[j], longest = std::ranges::max(lengths);
  const Pair pair(m1, m2);
  Eigen::Matrix4d squares = Eigen::Matrix4d::Zero();
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  const auto at = bends(pair, static_cast<double>(places(longest, m1)),
                        static_cast<double>(places(longest, m2)));
  for (const auto& [lag, weight] : lag_nodes(at)) {
    const double count = weight * pairs_at(lag, lengths, m1, m2);
    if (count == 0.0) continue;
    const Eigen::Vector4d c = covariance(pair, lag);
    squares += count * c * c.transpose();
    sum += count * c;
  }
  const double per = all_places(lengths, m1) * all_places(lengths, m2);
  for (int a = 0; a < random; ++a) {
    with_ramp_[a](i, j) = with_ramp_[a](j, i) = 2.0 * pair.m1 * pair.m2 * sum[a] / per;
    for (int b = a; b < random; ++b)
      products_[a][b](i, j) = products_[a][b](j, i) = (a == b ? 2.0 : 4.0) * squares(a, b) / per;
  }
}

Eigen::MatrixXd AllanCovariance::of(const AllanSquares& squares) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size_, size_);
  for (int a = 0; a < random; ++a) {
    all += squares[random] * squares[a] * with_ramp_[a];
    for (int b = a; b < random; ++b) all += squares[a] * squares[b] * products_[a][b];
  }
  return all;
}

}  // namespace drift::stats
