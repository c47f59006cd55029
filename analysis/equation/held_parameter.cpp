#include "analysis/equation/held_parameter.hpp"

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/signatures.hpp"

namespace drift::equation {

HeldFit fit_held(const FilterSpec& filter, const MeasuredTest& test, const BatchResult& near,
                 std::size_t param, double value, const VecX& weight,
                 const inference::NoiseModel& noise) {
  FilterSpec held = filter;
  held.priors[param] = fixed(value);
  Theta from = theta_of(filter, near);
  from[param] = value;
  HeldFit out{
      value, 0.0,
      fit_batch_from(held, test, from, near.psi0_l, {.result = BatchOptions::Result::estimates})};
  inference::LinearProblem problem = inference::linear_problem(held, test, out.fit, {});
  problem.weight = weight;
  out.log2 = inference::marginal_of(problem, noise).log_likelihood2();
  return out;
}

}  // namespace drift::equation
