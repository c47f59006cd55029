#include "analysis/equation/held_parameter.hpp"

#include <algorithm>
#include <utility>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/misalignments.hpp"
#include "analysis/inference/signatures.hpp"
#include "core/estimate/layout.hpp"

namespace drift::equation {

double loss_by_prior_of_lambda(const Prior& prior, double value) {
  if (!(prior.sigma() > 0.0)) return 0.0;
  const Prior& library = TermLibrary::specs[closure_param].prior;
  const bool own = prior.mean() == library.mean() && prior.sigma() == library.sigma();
  const double z = (value - prior.mean()) / prior.sigma();
  constexpr double of_an_end = 3.0;  // square of half a width in sigmas of equal chances
  return own ? std::max(0.0, z * z - of_an_end) : z * z;
}

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
