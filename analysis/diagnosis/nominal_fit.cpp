#include "analysis/diagnosis/nominal_fit.hpp"

#include "analysis/diagnosis/compare.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {

NominalFit fit_nominal(const FilterSpec& nominal, const MeasuredTest& given,
                       std::span<const Theta> starts) {
  constexpr int most_rounds = 4;  // a gross sample may hide a smaller one
  const Theta prior = make_layout(nominal).theta;
  NominalFit out;
  out.measured = given.measured;
  const MeasuredTest test{given.timeline, given.readout, out.measured};
  const auto fit_at = [&](const Theta& start) {
    return fit_batch(nominal, {test.timeline, test.readout, out.measured}, start);
  };
  out.fit = fit_at(prior);
  for (int round = 0; round < most_rounds; ++round) {
    identification::Despiked clean =
        identification::without_spikes(out.measured, test.timeline, test.readout, out.fit);
    if (clean.spikes.empty()) break;
    out.measured = std::move(clean.measured);
    out.spikes.insert(out.spikes.end(), clean.spikes.begin(), clean.spikes.end());
    out.fit = fit_at(theta_of(nominal, out.fit));
  }
  std::vector<BatchResult> fits = fit_from_starts(nominal, nominal, test, starts, prior);
  fits.push_back(out.fit);
  out.start_spread = start_spread(fits);
  for (BatchResult& other : fits)
    if (other.estimate.statistic < out.fit.estimate.statistic - 1e-6) out.fit = std::move(other);
  return out;
}

std::vector<BatchResult> fit_from_starts(const FilterSpec& nominal, const FilterSpec& filter,
                                         const MeasuredTest& test, std::span<const Theta> starts,
                                         const Theta& found) {
  return mc::run_campaign(starts.size(), [&](std::size_t k) {
    FilterSpec held = filter;
    Theta start = starts[k];
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      if (!nominal.active[i]) {
        start[i] = found[i];
        if (filter.active[i]) held.priors[i] = fixed(found[i]);
      }
    if (filter.active == nominal.active) return fit_batch(held, test, start);
    const BatchResult first =
        fit_batch(held, test, start, {.result = BatchOptions::Result::estimates});
    return fit_batch_from(filter, test, theta_of(held, first), first.psi0_l);
  });
}

}  // namespace drift::diagnosis
