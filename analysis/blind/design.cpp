#include "analysis/blind/design.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/shuffle.hpp"

namespace drift::blind {
namespace {

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
    case Stratum::noisy_single:
    case Stratum::noisy_covariate:
      return spec.sizes.empty() ? spec.smallest + (spec.largest - spec.smallest) * stream.uniform()
                                : spec.sizes[level];
    case Stratum::null:
    case Stratum::wrong_noise:
    case Stratum::other_equation:
      break;
  }
  return 0.0;
}

/// Trials of one stratum, plans, modes, couplings and sizes balanced; not numbered yet.
std::vector<TrialPlan> trials_of(const mc::BlindSpec& spec, Stratum stratum, std::size_t count,
                                 Stream stream) {
  const auto plan = balanced(count, spec.plans.size(), stream);
  const auto mode = balanced(count, spec.modes.size(), stream);
  const auto coupling = balanced(count, spec.couplings.size(), stream);
  const auto size = balanced(count, std::max<std::size_t>(1, spec.sizes.size()), stream);
  std::vector<TrialPlan> trials;
  for (std::size_t j = 0; j < count; ++j) {
    TrialPlan t;
    t.stratum = stratum;
    t.index = j;
    t.plan = spec.plans[plan[j]];
    t.mode = spec.modes[mode[j]];
    t.coupling = spec.couplings[coupling[j]];
    t.size = size_of(spec, stratum, size[j], stream);
    trials.push_back(t);
  }
  return trials;
}

/// Those that are asked for by number, one stratum after the other.
std::vector<TrialPlan> further_trials(const mc::BlindSpec& spec, std::uint64_t seed) {
  const std::pair<Stratum, std::uint64_t> asked[] = {
      {Stratum::other_equation, spec.further.other_equation},
      {Stratum::noisy_single, spec.further.noisy_single},
      {Stratum::noisy_covariate, spec.further.noisy_covariate}};
  std::vector<TrialPlan> trials;
  for (const auto& [stratum, count] : asked) {
    // The streams up to num_strata are those of the shares and of their order.
    const auto number = static_cast<std::uint32_t>(stratum) + 1;
    for (TrialPlan& t : trials_of(spec, stratum, count, Stream(seed, 0, Purpose::design, number)))
      trials.push_back(std::move(t));
  }
  return trials;
}

}  // namespace

std::vector<TrialPlan> design_trials(const mc::BlindSpec& spec, std::uint64_t seed) {
  const auto count = counts_of(spec.shares, spec.trials);
  std::vector<TrialPlan> trials;
  for (std::size_t s = 0; s < num_strata; ++s) {
    const Stream stream(seed, 0, Purpose::design, static_cast<std::uint32_t>(s));
    for (TrialPlan& t : trials_of(spec, strata[s].value, count[s], stream))
      trials.push_back(std::move(t));
  }
  Stream order(seed, 0, Purpose::design, static_cast<std::uint32_t>(num_strata));
  shuffle(trials, order);
  for (TrialPlan& t : further_trials(spec, seed)) trials.push_back(std::move(t));
  for (std::size_t k = 0; k < trials.size(); ++k) trials[k].number = k + 1;
  return trials;
}

}  // namespace drift::blind
