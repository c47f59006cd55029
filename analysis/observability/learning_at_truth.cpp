#include "analysis/observability/learning_at_truth.hpp"

#include <algorithm>

#include "analysis/observability/ranking.hpp"
#include "core/estimate/closure/closure_posterior.hpp"
#include "core/physics/stochastic.hpp"
#include "core/sim/own_term_steps.hpp"
#include "core/sim/predict.hpp"

namespace drift::observability {
namespace {

/// The estimate after a test without noise.
EstimateResult estimate_of(const TestPlan& plan, const RankedModel& model) {
  Timeline timeline = lay_out(plan, model.site);
  set_environment(timeline, model.environment, 0, 0);
  for (Interval& i : timeline.intervals) i.loop = model.loop;
  resolve_own_terms(timeline, model.spec);
  const std::vector<Vec3> level(static_cast<std::size_t>(timeline.chains), Vec3::Zero());
  const Measurements measured =
      predict(timeline, model.spec.model(), model.nominal, level, model.readout);
  FilterSpec filter;
  static_cast<ModelSpec&>(filter) = model.spec;
  const MeasuredTest test{timeline, model.readout, measured};
  return over_closure(filter, test, fit_batch_from(filter, test, model.nominal, level));
}

}  // namespace

std::vector<double> learning_at_truth(const TestPlan& plan, const RankedModel& model) {
  std::vector<double> ratios;
  const std::vector<std::size_t> states = make_layout(model.spec).params;
  if (std::ranges::find(states, closure_param) != states.end() && !drift_varies(model.spec)) {
    const EstimateResult e = estimate_of(plan, model);
    if (e.status == EstimateStatus::ok) {
      for (const ParameterEstimate& p : e.parameters) ratios.push_back(p.learning_ratio());
      return ratios;
    }
  }
  const Ranking r = rank_parameters(linearise(plan, model));
  for (const ParameterRank& p : r.parameters) ratios.push_back(p.learning_ratio());
  return ratios;
}

}  // namespace drift::observability
