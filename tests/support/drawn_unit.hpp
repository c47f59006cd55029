#pragma once

#include <algorithm>
#include <cstdint>

#include "core/base/rng.hpp"
#include "core/estimate/strapdown/case_test.hpp"
#include "core/physics/model_spec.hpp"

namespace drift::test {

/// Sensors on a case drawn from what is believed of each of a filter's parameters: prior(index).
template <class PriorOf>
Theta drawn_unit(const FilterSpec& filter, std::uint64_t seed, PriorOf&& prior) {
  Stream stream(seed, 0, Purpose::test, 7);
  Theta theta = Theta::Zero();
  for (std::size_t p = 0; p < TermLibrary::num_params; ++p)
    if (filter.active[p] &&
        std::ranges::find(strapdown::zero_by_definition, p) == strapdown::zero_by_definition.end())
      theta[static_cast<Eigen::Index>(p)] = prior(p).sigma() * stream.normal();
  return theta;
}

/// A unit of a laboratory: by the library's priors.
inline Theta drawn_unit(const FilterSpec& filter, std::uint64_t seed) {
  return drawn_unit(filter, seed, [](std::size_t p) { return TermLibrary::specs[p].prior_si(); });
}

}  // namespace drift::test
