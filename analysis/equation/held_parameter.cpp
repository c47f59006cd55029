#include "analysis/equation/held_parameter.hpp"

#include "analysis/inference/projector.hpp"
#include "analysis/inference/signatures.hpp"

namespace drift::equation {

HeldFit fit_held(const FilterSpec& filter, const MeasuredTest& test, const Theta& start,
                 std::size_t param, double value, const VecX& weight,
                 const inference::NoiseModel& noise) {
  FilterSpec held = filter;
  held.priors[param] = fixed(value);
  Theta from = start;
  from[param] = value;
  HeldFit out{value, 0.0, fit_batch(held, test, from)};
  inference::LinearProblem problem = inference::linear_problem(held, test, out.fit, {});
  problem.weight = weight;
  out.log2 = inference::Projector(problem, noise).marginal().log_likelihood2();
  return out;
}

}  // namespace drift::equation
