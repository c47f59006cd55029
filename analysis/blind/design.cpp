#include "analysis/blind/design.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/rng.hpp"

namespace drift::blind {
namespace {

template <class T>
void shuffle(std::vector<T>& list, Stream& stream) {
  for (std::size_t k = list.size(); k > 1; --k)
    std::swap(list[k - 1],
              list[static_cast<std::size_t>(stream.uniform() * static_cast<double>(k))]);
}

/// Numbers 0..levels-1, each equally often (but for one), n of them in random order.
std::vector<std::size_t> balanced(std::size_t n, std::size_t levels, Stream& stream) {
  std::vector<std::size_t> list(n);
  for (std::size_t k = 0; k < n; ++k) list[k] = k % levels;
  shuffle(list, stream);
  return list;
}

/// Trials of each stratum: shares of the whole, rounded so that they add up.
std::vector<std::size_t> counts_of(const mc::BlindShares& shares, std::size_t trials) {
  const double weight[num_strata] = {shares.null, shares.wrong_noise, shares.single,
                                     shares.pair, shares.outside,     shares.local};
  std::vector<std::size_t> count(num_strata), order(num_strata);
  std::vector<double> rest(num_strata);
  std::size_t given = 0;
  for (std::size_t s = 0; s < num_strata; ++s) {
    const double exact = static_cast<double>(trials) * weight[s] / shares.sum();
    count[s] = static_cast<std::size_t>(exact);
    rest[s] = exact - std::floor(exact);
    given += count[s];
  }
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return rest[a] > rest[b]; });
  for (std::size_t k = 0; given < trials; ++k, ++given) ++count[order[k % num_strata]];
  return count;
}

double size_of(const mc::BlindSpec& spec, Stratum stratum, std::size_t level, Stream& stream) {
  switch (stratum) {
    case Stratum::pair:
      return spec.pair_size;
    case Stratum::outside:
      return spec.outside_size;
    case Stratum::single:
    case Stratum::local:
      return spec.sizes.empty() ? spec.smallest + (spec.largest - spec.smallest) * stream.uniform()
                                : spec.sizes[level];
    case Stratum::null:
    case Stratum::wrong_noise:
      break;
  }
  return 0.0;
}

}  // namespace

std::vector<TrialPlan> design_trials(const mc::BlindSpec& spec, std::uint64_t seed) {
  const auto count = counts_of(spec.shares, spec.trials);
  std::vector<TrialPlan> trials;
  for (std::size_t s = 0; s < num_strata; ++s) {
    Stream stream(seed, 0, Purpose::design, static_cast<std::uint32_t>(s));
    const auto plan = balanced(count[s], spec.plans.size(), stream);
    const auto mode = balanced(count[s], spec.modes.size(), stream);
    const auto coupling = balanced(count[s], spec.couplings.size(), stream);
    const auto size = balanced(count[s], std::max<std::size_t>(1, spec.sizes.size()), stream);
    for (std::size_t j = 0; j < count[s]; ++j) {
      TrialPlan t;
      t.stratum = strata[s].value;
      t.index = j;
      t.plan = spec.plans[plan[j]];
      t.mode = spec.modes[mode[j]];
      t.coupling = spec.couplings[coupling[j]];
      t.size = size_of(spec, t.stratum, size[j], stream);
      trials.push_back(t);
    }
  }
  Stream order(seed, 0, Purpose::design, static_cast<std::uint32_t>(num_strata));
  shuffle(trials, order);
  for (std::size_t k = 0; k < trials.size(); ++k) trials[k].number = k + 1;
  return trials;
}

}  // namespace drift::blind
