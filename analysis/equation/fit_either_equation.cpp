#include "analysis/equation/fit_either_equation.hpp"

#include <utility>

namespace drift::equation {
namespace {

constexpr BatchOptions patient{.max_iterations =
                                   200};  // along a valley each step is a small part of it

}  // namespace

BatchResult fit_either_equation(const FilterSpec& filter, const MeasuredTest& test,
                                const Theta& start) {
  if (filter.coupling != Coupling::lambda || !filter.active[closure_param] ||
      filter.priors[closure_param].sigma() <= 0.0)
    return fit_batch(filter, test, start);
  BatchResult best = fit_batch(filter, test, start, patient);
  for (const double end : {0.0, 1.0}) {
    FilterSpec held = filter;
    held.priors[closure_param] = fixed(end);
    Theta from = start;
    from[closure_param] = end;
    from = theta_of(held, fit_batch(held, test, from));
    BatchResult other = fit_batch(filter, test, from, patient);
    if (other.estimate.statistic < best.estimate.statistic) best = std::move(other);
  }
  for (ParameterEstimate& p : best.estimate.parameters) p.start = start[p.param];
  return best;
}

}  // namespace drift::equation
