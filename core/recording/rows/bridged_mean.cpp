#include "core/recording/rows/bridged_mean.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/linalg.hpp"

namespace drift {
namespace {

constexpr double sine_error = 2e-6, least_measured = 0.5, least_kept = 0.5;
constexpr int highest_degree = 4;

/// Largest error of the best polynomial for a sine over an angle (Chebyshev's remainder).
std::optional<int> degree_for(double turned) {
  double remainder = 0.5 * turned;
  for (int degree = 1; degree <= highest_degree; ++degree) {
    remainder *= 0.5 * turned / (2.0 * (degree + 1));
    if (remainder < sine_error) return degree;
  }
  return std::nullopt;
}

/// Means of 1, x, x^2, ... over [a, b].
VecX means_of_powers(double a, double b, int degree) {
  VecX m(degree + 1);
  double at_a = a, at_b = b;
  for (int k = 0; k <= degree; ++k) {
    m[k] = (at_b - at_a) / ((k + 1) * (b - a));
    at_a *= a;
    at_b *= b;
  }
  return m;
}

}  // namespace

BridgedMean bridged_mean(const std::vector<double>& begins, const std::vector<double>& ends,
                         const std::vector<double>& values, const RowSpan& rows, double turned) {
  const BridgedMean none{std::numeric_limits<double>::quiet_NaN(), 0.0};
  const double begin = begins[rows.first], end = ends[rows.end - 1];
  double measured = 0.0, sum = 0.0;
  int count = 0;
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    const double length = ends[row] - begins[row];
    measured += length;
    sum += length * values[row];
    ++count;
  }
  if (measured >= (1.0 - 1e-9) * (end - begin)) return {sum / measured, measured};
  const auto degree = degree_for(turned);
  if (!degree || measured < least_measured * (end - begin) || count < 2 * (*degree + 1))
    return none;

  const double centre = 0.5 * (begin + end), half = 0.5 * (end - begin);
  const auto powers = [&](std::size_t row) {
    return means_of_powers((begins[row] - centre) / half, (ends[row] - centre) / half, *degree);
  };
  MatX normal = MatX::Zero(*degree + 1, *degree + 1);
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    const VecX p = powers(row);
    normal += (ends[row] - begins[row]) * p * p.transpose();
  }
  const VecX towards = normal.ldlt().solve(means_of_powers(-1.0, 1.0, *degree));
  double value = 0.0, variance = 0.0;  // of white noise of 1 per root second
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    if (!std::isfinite(values[row])) continue;
    const double length = ends[row] - begins[row], weight = length * powers(row).dot(towards);
    value += weight * values[row];
    variance += weight * weight / length;
  }
  if (!(variance * measured * least_kept < 1.0)) return none;
  return {value, 1.0 / variance};
}

}  // namespace drift
