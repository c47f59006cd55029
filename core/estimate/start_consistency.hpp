#pragma once

#include <cmath>
#include <span>

namespace drift {

/// Do answers from several starts agree as well as their sigmas say they should?
///
/// ratio = standard deviation between starts / RMS of the reported sigmas. A linear filter with
/// static parameters moves by sigma_post (sigma_post / sigma_prior) per prior sigma of the start,
/// so the ratio of a sound filter is far below 1 (physics.md 3.5). NaN for fewer than two starts.
inline double start_consistency(std::span<const double> values, std::span<const double> sigmas) {
  double mean = 0.0, mean_square = 0.0, spread = 0.0;
  const auto n = static_cast<double>(values.size());
  for (const double v : values) mean += v / n;
  for (const double v : values) spread += (v - mean) * (v - mean) / (n - 1.0);
  for (const double s : sigmas) mean_square += s * s / n;
  return values.size() < 2 ? std::nan("") : std::sqrt(spread / mean_square);
}

/// Verdict on a start-consistency ratio (engine.md section 1).
enum class StartVerdict { consistent, doubtful, depends_on_start };

inline StartVerdict start_verdict(double ratio) {
  if (ratio > 5.0) return StartVerdict::depends_on_start;
  return ratio > 2.0 ? StartVerdict::doubtful : StartVerdict::consistent;
}

}  // namespace drift
