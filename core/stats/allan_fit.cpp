#include "core/stats/allan_fit.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/base/check.hpp"
#include "core/stats/allan_squares.hpp"
#include "core/stats/chi_square.hpp"

namespace drift::stats {
namespace {

using Boosts = boost::math::chi_squared;
constexpr double chance = 0.001;  // of a misfit that is believed
/// Degrees of freedom are not counted beyond this: the interval of a variance is then within 3e-4
/// of it. Of a ramp alone, which does not fluctuate, they are without bound, and quantiles of
/// chi-square are no longer found from 1e12 on.
constexpr double most_dof = 1e8;

/// Of a variance that is expected, with the variance of its estimates; one at least.
double degrees_of_freedom(double expected, double spread) {
  return std::min(std::max(1.0, 2.0 * expected * expected / spread), most_dof);
}

std::size_t longest_of(std::span<const std::size_t> lengths) {
  DRIFT_DEMAND(!lengths.empty());
  return std::ranges::max(lengths);
}

std::vector<std::size_t> counts_up_to(std::span<const std::size_t> lengths, std::size_t most) {
  auto counts = averaging_counts(longest_of(lengths));
  std::erase_if(counts, [&](std::size_t m) { return m > most; });
  return counts;
}

std::vector<std::size_t> powers_of_two(std::vector<std::size_t> counts) {
  std::erase_if(counts, [](std::size_t m) { return (m & (m - 1)) != 0; });
  return counts;
}

AllanProblem problem_of(const AllanCovariance& covariance, std::span<const std::size_t> counts,
                        std::span<const Stretch> stretches) {
  const std::vector<double> variances = allan_variances(stretches, counts);
  const auto n = static_cast<Eigen::Index>(counts.size());
  AllanProblem problem{Eigen::Map<const Eigen::VectorXd>(variances.data(), n),
                       Eigen::Matrix<double, Eigen::Dynamic, allan_noises>(n, allan_noises),
                       covariance};
  for (Eigen::Index k = 0; k < n; ++k)
    problem.slopes.row(k) = allan_slopes(static_cast<double>(counts[k])).transpose();
  return problem;
}

/// How a square that is zero would be estimated: its sigma, and the degrees of freedom of the
/// averaging time that says most of it, whose skewness it has.
struct UnderNull {
  double estimate = 0.0, sigma = 0.0, dof = 1.0;
};

UnderNull as_if(const AllanProblem& problem, AllanSet set, int noise, const AllanSquares& squares) {
  set[noise] = true;
  const Eigen::MatrixXd covariance = problem.covariance.of(squares);
  const AllanEstimate free = free_estimate(problem, set, covariance);
  UnderNull out{free.squares[noise], std::sqrt(free.covariance(noise, noise)), 1.0};
  const Eigen::ArrayXd sigma = covariance.diagonal().array().sqrt();
  Eigen::Index most = 0;
  (free.weights.row(noise).transpose().array() * sigma).maxCoeff(&most);
  const double expected = problem.slopes.row(most).dot(squares);
  out.dof = degrees_of_freedom(expected, covariance(most, most));
  return out;
}

/// Chance of so much of a noise that is not there.
double chance_of(const UnderNull& u, double inflation) {
  const double t = u.dof + u.estimate / (u.sigma * inflation) * std::sqrt(2.0 * u.dof);
  return t > 0.0 ? std::exp(log_tail(t, u.dof)) : 1.0;
}

/// The square that would show as little as was found with 5 % only.
double upper_square(const AllanProblem& problem, const AllanSet& set, int noise,
                    AllanSquares squares, double inflation) {
  constexpr double level = 0.05;
  // A fluctuation below zero must not make the limit better than the recording is.
  const double found = std::max(0.0, as_if(problem, set, noise, squares).estimate);
  const auto shortfall = [&](double square) {
    squares[noise] = square;
    const UnderNull u = as_if(problem, set, noise, squares);
    const double quantile =
        (boost::math::quantile(Boosts(u.dof), level) - u.dof) / std::sqrt(2.0 * u.dof);
    return square + quantile * u.sigma * inflation - found;  // grows with the square
  };
  squares[noise] = 0.0;
  const UnderNull null = as_if(problem, set, noise, squares);
  double low = 0.0, high = found + null.sigma * inflation;
  for (int i = 0; i < 60 && shortfall(high) < 0.0; ++i) high *= 2.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (shortfall(middle) < 0.0 ? low : high) = middle;
  }
  return high;
}

/// Another noise in the place of one that was found, as good.
struct Swap {
  int found = 0, rival = 0;
  AllanEstimate estimate;
};

struct Selected {
  AllanSet set{};
  AllanEstimate estimate;
  std::array<double, allan_noises> p;
  std::vector<Swap> swaps;
};

/// Slow noises rise at long averaging times only, where a series is short: each found one is
/// compared with the others.
std::vector<Swap> swaps_of(const AllanProblem& problem, const AllanSet& allowed,
                           const AllanSet& set, double inflation) {
  constexpr int slow = static_cast<int>(AllanNoise::flicker);
  std::vector<Swap> out;
  for (int found = slow; found < allan_noises; ++found)
    for (int rival = slow; rival < allan_noises; ++rival) {
      if (!set[found] || set[rival] || !allowed[rival]) continue;
      AllanSet other = set;
      other[found] = false;
      other[rival] = true;
      if (!has_noise(other)) continue;
      AllanEstimate estimate = estimate_squares(problem, other);
      const UnderNull missing = as_if(problem, other, found, estimate.squares);
      if (estimate.squares[rival] > 0.0 && chance_of(missing, inflation) > allan_significance)
        out.push_back({found, rival, std::move(estimate)});
    }
  return out;
}

/// Takes out what is not distinguished from zero, the least probable first.
Selected select(const AllanProblem& problem, const AllanSet& set, const AllanEstimate& full,
                double inflation) {
  Selected out{set, full, {}, {}};
  out.p.fill(1.0);
  while (true) {
    int weakest = -1;
    AllanEstimate without;
    for (int a = 0; a < allan_noises; ++a) {
      AllanSet rest = out.set;
      rest[a] = false;
      if (!out.set[a]) continue;
      out.p[a] = 0.0;
      if (!has_noise(rest)) continue;  // something random there is
      AllanEstimate null = estimate_squares(problem, rest);
      out.p[a] = out.estimate.squares[a] > 0.0
                     ? chance_of(as_if(problem, rest, a, null.squares), inflation)
                     : 1.0;
      if (out.p[a] <= allan_significance || (weakest >= 0 && out.p[a] <= out.p[weakest])) continue;
      weakest = a;
      without = std::move(null);
    }
    if (weakest < 0) {
      out.swaps = swaps_of(problem, set, out.set, inflation);
      return out;
    }
    out.set[weakest] = false;
    out.estimate = std::move(without);
  }
}

/// A coefficient from its square with time in samples; `unit`: sample interval to the power that
/// makes it one with time in seconds.
AllanCoefficient coefficient(const AllanProblem& problem, const Selected& chosen, int noise,
                             double inflation, double unit) {
  AllanCoefficient out;
  out.p = chosen.p[noise];
  out.found = chosen.set[noise];
  if (out.found) {
    out.value = std::sqrt(chosen.estimate.squares[noise]) * unit;
    const double sigma = std::sqrt(chosen.estimate.covariance(noise, noise)) * inflation * unit *
                         unit / (2.0 * out.value);
    double moved = 0.0;  // by a rival of another coefficient
    for (const Swap& swap : chosen.swaps) {
      if (swap.found == noise) out.rivals.push_back(static_cast<AllanNoise>(swap.rival));
      const double square = swap.estimate.squares[noise];
      if (swap.found != noise && square > 0.0)
        moved = std::max(moved, std::abs(std::sqrt(square) * unit - out.value));
    }
    out.sigma = std::hypot(sigma, moved);
  } else {
    out.upper = unit * std::sqrt(upper_square(problem, chosen.set, noise, chosen.estimate.squares,
                                              inflation));
  }
  return out;
}

}  // namespace

AllanFitter::AllanFitter(std::span<const std::size_t> lengths, double interval, std::size_t most)
    : counts_(counts_up_to(lengths, most)),
      octaves_(powers_of_two(counts_)),
      interval_(interval),
      each_(lengths, counts_, AllanCovariance::Pairs::diagonal),
      covariance_(lengths, octaves_) {}

AllanFit AllanFitter::fit(std::span<const Stretch> stretches,
                          std::span<const AllanNoise> noises) const {
  DRIFT_DEMAND(possible());
  const AllanProblem problem = problem_of(covariance_, octaves_, stretches);
  AllanSet all{};
  for (const AllanNoise noise : noises) all[static_cast<std::size_t>(noise)] = true;
  const AllanEstimate full = estimate_squares(problem, all);
  AllanFit out;
  const double dof = static_cast<double>(octaves_.size()) -
                     static_cast<double>((full.squares.array() > 0.0).count());
  if (dof > 0.0) {
    out.misfit = full.chi_square / dof;
    out.fits = log_tail(full.chi_square, dof) > std::log(chance);
  }
  const double inflation = out.fits ? 1.0 : std::sqrt(out.misfit);
  const Selected chosen = select(problem, all, full, inflation);
  for (const AllanNoise noise : noises) {
    const int a = static_cast<int>(noise);
    out.coefficients[a] =
        coefficient(problem, chosen, a, inflation, std::pow(interval_, 1.0 - 0.5 * a));
  }
  const std::vector<double> variances = allan_variances(stretches, counts_);
  const Eigen::VectorXd spread = each_.of(chosen.estimate.squares).diagonal();
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    AllanPoint p;
    p.tau = static_cast<double>(counts_[i]) * interval_;
    p.deviation = std::sqrt(variances[i]);
    const double fitted =
        allan_slopes(static_cast<double>(counts_[i])).dot(chosen.estimate.squares);
    p.fitted = std::sqrt(fitted);
    p.dof = degrees_of_freedom(fitted, spread[static_cast<Eigen::Index>(i)]);
    const Boosts chi(p.dof);
    p.low = p.deviation * std::sqrt(p.dof / boost::math::quantile(chi, 0.975));
    p.high = p.deviation * std::sqrt(p.dof / boost::math::quantile(chi, 0.025));
    out.points.push_back(p);
  }
  return out;
}

}  // namespace drift::stats
