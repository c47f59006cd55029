#include "mc/statistics/distribution_bins.hpp"

#include <algorithm>
#include <cmath>

#include "core/stats/chi_square.hpp"
#include "core/stats/normal.hpp"

namespace drift::mc {

void DistributionBins::add(double probability) {
  if (std::isnan(probability)) return;
  const double at = std::clamp(probability, 0.0, 1.0) * static_cast<double>(size);
  ++counts_[std::min(static_cast<std::size_t>(at), size - 1)];
  ++total_;
}

stats::Rate DistributionBins::up_to(std::size_t bin) const {
  stats::Rate rate{0, total_};
  for (std::size_t b = 0; b <= bin && b < size; ++b) rate.hits += counts_[b];
  return rate;
}

double chi_square_probability(double value, double dof) {
  return -std::expm1(stats::log_tail(value, dof));
}

double magnitude_probability(double z) {
  // A study has millions of errors: bins are found among their edges instead of by the error
  // function.
  constexpr std::size_t n = DistributionBins::size;
  static const std::array<double, n - 1> edges = [] {
    std::array<double, n - 1> all{};
    for (std::size_t k = 0; k + 1 < n; ++k)
      all[k] = stats::normal_half_width(static_cast<double>(k + 1) / static_cast<double>(n));
    return all;
  }();
  if (std::isnan(z)) return z;
  const auto bin = std::ranges::upper_bound(edges, std::abs(z)) - edges.begin();
  return (static_cast<double>(bin) + 0.5) / static_cast<double>(n);
}

void RateCourse::follow(const stats::Rate& so_far) {
  if (so_far.of < next_) return;
  steps_.push_back(so_far);
  next_ = so_far.of + std::max<std::uint64_t>(1, so_far.of / 10);
}

}  // namespace drift::mc
