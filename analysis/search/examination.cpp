#include "analysis/search/examination.hpp"

#include <cmath>

namespace drift::search {

inference::NoiseModel declared_noise(const FilterSpec& filter) {
  inference::NoiseModel m;
  m.angle_random_walk = filter.noise.angle_random_walk;
  m.drift_random_walk = filter.noise.drift_random_walk;
  return m;
}

namespace {

/// Prior cost of the fitted misalignments, which lambda could save by rescaling them.
double cost_of_misalignments(const FilterSpec& filter, const BatchResult& fit) {
  double cost = 0.0;
  for (const ParameterEstimate& p : fit.estimate.parameters) {
    const auto group = TermLibrary::specs[p.param].group.view();
    if (group != "eta" && group != "xi") continue;
    const auto& prior = filter.priors[p.param];
    if (prior.sigma() > 0.0) cost += std::pow((p.value - prior.mean()) / prior.sigma(), 2);
  }
  return cost;
}

}  // namespace

void set_noise(Examination& e, const Timeline& timeline, const inference::NoiseEstimate& noise) {
  e.noise = noise;
  e.projector = std::make_unique<inference::Projector>(e.problem, noise.model);
  e.scans = inference::scan_windows(e.problem, timeline, *e.projector);
  e.field = std::make_unique<Field>(e.set, e.projector->candidates(), e.scans);
  const double cost = cost_of_misalignments(e.filter, e.fit);
  for (const inference::Candidate& c : e.set.candidates)
    e.field->discount.push_back(c.term == "frame_closure" ? cost : 0.0);
  e.scores.clear();
  for (std::size_t k = 0; k < e.set.candidates.size(); ++k) e.scores.push_back(score(*e.field, k));
}

Examination examine(const FilterSpec& filter, const inference::Test& test, const BatchResult& fit,
                    const inference::NoiseEstimate* given, bool driven) {
  Examination e;
  e.filter = filter;
  e.fit = fit;
  e.set = inference::library_candidates(filter, inference::theta_of(filter, e.fit), test.timeline);
  e.problem = inference::linear_problem(filter, test, e.fit, e.set.signatures);
  const inference::NoiseModel declared = declared_noise(filter);
  const VecX residual = inference::residual_of(e.problem, e.fit);
  const inference::NoiseEstimate differences = inference::noise_of_differences(e.problem, residual);
  if (!given && inference::grossly_wrong(e.problem, residual, differences)) {
    set_noise(e, test.timeline, differences);
    return e;
  }
  const inference::Projector first(e.problem, given ? given->model : declared);
  inference::robust_weights(e.problem, first.clean_residual());
  set_noise(e, test.timeline,
            given ? *given : inference::estimate_noise(e.problem, declared, {}, driven ? 4 : 0));
  return e;
}

Examination examine(const FilterSpec& filter, const inference::Test& test, const Theta& start,
                    const inference::NoiseEstimate* given) {
  return examine(filter, test, fit_batch(filter, test.timeline, test.readout, test.measured, start),
                 given);
}

Nulls make_nulls(const Examination& e, double alpha, int draws) {
  Nulls n{inference::MaxNull(e.projector->candidates().C, e.field->all_contrasts(), draws, 1),
          inference::scan_null(e.scans, std::max(200, draws / 4))};
  n.library_threshold = n.library.threshold(alpha * library_share);
  // A window by chance must not rule out a cause: thousands are looked at.
  n.scan_threshold = n.scan.threshold(alpha * scan_share / 3.0);
  return n;
}

}  // namespace drift::search
