#include "analysis/search/fitted.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/noise/gross_misfit.hpp"
#include "analysis/inference/noise/robust_weights.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/physics/stochastic.hpp"

namespace drift::search {
namespace {

/// Prior cost of the fitted misalignments, which lambda could save by rescaling them.
double cost_of_misalignments(const FilterSpec& filter, const BatchResult& fit) {
  double cost = 0.0;
  for (const ParameterEstimate& p : fit.estimate.parameters) {
    if (!inference::is_misalignment(p.param)) continue;
    const auto& prior = filter.priors[p.param];
    if (prior.sigma() > 0.0) cost += std::pow((p.value - prior.mean()) / prior.sigma(), 2);
  }
  return cost;
}

/// Linearised, without noise and scores.
Fitted linearised(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit,
                  const Fitted* beside) {
  Fitted f;
  f.filter = filter;
  f.fit = fit;
  f.set = inference::library_candidates(filter, theta_of(filter, fit), test.timeline);
  if (!beside) {
    f.problem = inference::linear_problem(filter, test, fit, f.set.signatures);
    return f;
  }
  const inference::KnownSignatures known{beside->filter, beside->fit, beside->set.signatures,
                                         beside->problem.extra};
  f.cross = inference::Cross::left_out;
  f.problem = inference::linear_problem(filter, test, fit, f.set.signatures, &known);
  return f;
}

/// With less weight on what is no Gaussian noise, the noise about as given.
void lower_outliers(inference::LinearProblem& problem, const inference::NoiseModel& noise) {
  const inference::Projector first(problem.bare(), noise);
  problem.weight = inference::robust_weights(problem, first.clean_residual());
}

/// Columns that some candidate has at one of its settings, with all that others have with them.
std::vector<std::vector<int>> columns_together(const inference::CandidateSet& set) {
  std::vector<std::vector<int>> groups;
  std::vector<std::size_t> group_of(set.signatures.size());
  for (std::size_t k = 0; k < group_of.size(); ++k) {
    group_of[k] = k;
    groups.push_back({static_cast<int>(k)});
  }
  for (const inference::Candidate& c : set.candidates)
    for (const inference::Variant& v : c.variants)
      for (const int column : v.columns) {
        const std::size_t to = group_of[static_cast<std::size_t>(v.columns.front())],
                          from = group_of[static_cast<std::size_t>(column)];
        if (to == from) continue;
        for (const int moved : groups[from]) group_of[static_cast<std::size_t>(moved)] = to;
        groups[to].insert(groups[to].end(), groups[from].begin(), groups[from].end());
        groups[from].clear();
      }
  std::erase_if(groups, [](const std::vector<int>& g) { return g.empty(); });
  return groups;
}

}  // namespace

inference::NoiseModel declared_noise(const FilterSpec& filter) {
  inference::NoiseModel m;
  m.angle_random_walk = filter.noise.angle_random_walk;
  const TermMask terms = filter.model().terms;
  const Theta theta = make_layout(filter).theta;
  Vec3 walk, level;
  for (int gyro = 0; gyro < 3; ++gyro) {
    walk[gyro] = drift_walk(filter.noise, terms, theta, gyro);
    level[gyro] = is_bistable(terms) ? bistable_size(theta, gyro) : 0.0;
  }
  const auto over_gyros = [](const Vec3& v) { return v.norm() / std::sqrt(3.0); };
  m.drift_random_walk = over_gyros(walk);
  m.markov_drift = over_gyros(level);
  // Two levels are correlated as a Markov process is: exp(-2 T / dwell).
  if (m.markov_drift > 0.0) m.markov_tau = 0.5 * bistable_dwell(theta);
  // One weight of each gyro for all that drives the platform.
  const double either = m.drift_random_walk + m.markov_drift;
  if (m.angle_random_walk == 0.0 && either > 0.0 &&
      (m.drift_random_walk == 0.0 || m.markov_drift == 0.0))
    m.gyros = (walk + level) / either;
  return m;
}

StrongestInputs Fitted::strongest_inputs() const {
  return unknown ? *unknown
                 : StrongestInputs{inference::strongest_lone_input(problem, noise.model),
                                   inference::strongest_periodic_input(problem, *projector)};
}

double Fitted::log_gain_of_misalignments() const {
  return inference::log_gain_of_misalignments(make_layout(filter), *projector);
}

const inference::PeriodicInput* Fitted::leading_period() const {
  if (!unknown || unknown->periodic.p_value() >= inference::RemarkLimits::lone_p) return nullptr;
  const double of_free_form = 0.5 * unknown->lone.gain - std::log(inference::WeighLimits::forms);
  return unknown->periodic.log_gain() > of_free_form ? &unknown->periodic : nullptr;
}

void Fitted::forget_signatures() {
  problem.extra.resize(problem.rows(), 0);
  if (projector) projector->forget_candidates();
  projected = {};
  contrasts = {};
  scans = {};
}

std::vector<std::size_t> Fitted::by_evidence() const {
  std::vector<std::size_t> order(scores.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t k) { return scores[k].log_bayes; });
  std::erase_if(order, [&](std::size_t k) { return scores[k].dof == 0; });
  return order;
}

Fitted with_noise(Fitted f, const Timeline& timeline, const inference::NoiseEstimate& noise) {
  if (noise.model != f.noise.model) f.unknown.reset();
  f.noise = noise;
  f.projector.emplace(f.problem, noise.model);
  inference::Projected candidates = f.cross == inference::Cross::known
                                        ? f.projector->candidates()
                                        : f.projector->candidates_in(columns_together(f.set));
  static_cast<Field&>(f) = {std::move(f.set), std::move(candidates),
                            inference::scan_windows(f.problem, timeline, *f.projector, f.cross)};
  const double cost = cost_of_misalignments(f.filter, f.fit);
  for (const inference::Candidate& c : f.set.candidates)
    f.discount.push_back(c.term == closure_term ? cost : 0.0);
  f.scores.clear();
  for (std::size_t k = 0; k < f.set.candidates.size(); ++k) f.scores.push_back(score(f, k));
  return f;
}

Fitted examine(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit,
               const inference::NoiseEstimate& known, const Fitted* beside) {
  Fitted f = linearised(filter, test, fit, beside);
  lower_outliers(f.problem, known.model);
  return with_noise(std::move(f), test.timeline, known);
}

Fitted examine(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& fit,
               NoiseKinds kinds, const Fitted* beside) {
  Fitted f = linearised(filter, test, fit, beside);
  const VecX residual = inference::residual_of(f.problem, fit);
  const inference::NoiseEstimate differences = inference::noise_of_differences(f.problem, residual);
  const inference::NoiseModel declared = declared_noise(filter);
  f.gross = inference::grossly_wrong(f.problem, residual, differences) &&
            (kinds == NoiseKinds::white ||
             !inference::driven_as_usual(f.problem, inference::estimate_noise(f.problem, declared),
                                         declared));
  if (f.gross) return with_noise(std::move(f), test.timeline, differences);
  lower_outliers(f.problem, declared);
  const bool differ = beside != nullptr && inference::caging_drift.in(beside->noise.model);
  const inference::NoiseEstimate noise =
      kinds == NoiseKinds::white
          ? inference::estimate_noise(f.problem, declared, {}, 0)
          : inference::estimate_noise(
                f.problem, declared, {}, inference::NoiseLimits::most_components,
                differ ? inference::Cagings::may_differ : inference::Cagings::alike);
  return with_noise(std::move(f), test.timeline, noise);
}

}  // namespace drift::search
