#pragma once

#include "core/estimate/layout.hpp"
#include "core/sim/truth.hpp"

namespace drift {

/// Initial estimates that a filter is run from.
inline std::size_t start_count(const FilterSpec& filter) {
  return filter.starts.empty() ? static_cast<std::size_t>(filter.drawn_starts)
                               : filter.starts.size();
}

/// The explicit start, or the prior means where it says nothing.
inline Theta explicit_start(const FilterSpec& filter, std::size_t start) {
  Theta theta = make_layout(filter).theta;
  for (const auto& [param, value] : filter.starts[start]) theta[param] = value;
  return theta;
}

/// For one recording: explicit, or drawn from the prior (pure function of seed, start).
inline Theta initial_estimate(const FilterSpec& filter, std::uint64_t seed, std::size_t start) {
  if (!filter.starts.empty()) return explicit_start(filter, start);
  return draw_parameters(filter, seed, start, Purpose::filter_start);
}

/// For a run of a study: explicit; else start 0 is the prior mean and the others are drawn from the
/// prior (pure function of seed, run, start; filters with equal priors start alike).
///
/// Only from the prior mean does a sigma mean what it says: an estimate that starts one prior sigma
/// off in a direction that the test does not see stays there (its error then has variance 2 P0).
inline Theta initial_estimate(const FilterSpec& filter, std::uint64_t seed, std::uint64_t run,
                              std::size_t start) {
  if (!filter.starts.empty()) return explicit_start(filter, start);
  if (start == 0) return make_layout(filter).theta;
  const auto purpose = static_cast<Purpose>(static_cast<std::uint32_t>(Purpose::filter_start) |
                                            static_cast<std::uint32_t>(start) << 8);
  return draw_parameters(filter, seed, run, purpose);
}

}  // namespace drift
