#include "analysis/equation/held_parameter.hpp"

#include <utility>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/signatures.hpp"
#include "core/estimate/layout.hpp"

namespace drift::equation {

HeldFit fit_held(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& near,
                 std::size_t param, double value, const VecX& weight,
                 const inference::NoiseModel& noise) {
  FilterSpec held = filter;
  held.priors[param] = fixed(value);
  const auto fit_from = [&](Theta from) {
    from[param] = value;
    return fit_batch_from(held, test, from, near.psi0_l,
                          {.result = BatchOptions::Result::estimates});
  };
  HeldFit out{value, 0.0, fit_from(theta_of(filter, near))};
  // Of the misalignments a test shows what lambda leaves of them: what fits one lambda may be far
  // off at the next, beyond a ridge.
  if (param == closure_param)
    if (BatchResult other = fit_from(make_layout(filter).theta);
        other.estimate.statistic < out.fit.estimate.statistic)
      out.fit = std::move(other);
  inference::LinearProblem problem = inference::linear_problem(held, test, out.fit, {});
  problem.weight = weight;
  if (param != closure_param) {
    out.log2 = inference::marginal_of(problem, noise).log_likelihood2();
    return out;
  }
  const inference::Projector there(problem, noise);
  out.log2 = there.marginal().log_likelihood2() +
             2.0 * inference::log_gain_of_misalignments(make_layout(held), there);
  return out;
}

}  // namespace drift::equation
