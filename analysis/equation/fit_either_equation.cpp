#include "analysis/equation/fit_either_equation.hpp"

#include <utility>

namespace drift::equation {
namespace {

constexpr auto lambda = TermLibrary::index("lambda");
constexpr BatchOptions patient{.max_iterations =
                                   200};  // along a valley each step is a small part of it

Theta theta_of(const FilterSpec& filter, const BatchResult& fit) {
  Theta theta = make_layout(filter).theta;
  for (const ParameterEstimate& p : fit.estimate.parameters) theta[p.param] = p.value;
  return theta;
}

}  // namespace

BatchResult fit_either_equation(const FilterSpec& filter, const Timeline& timeline,
                                const Readout& readout, const Measurements& measured,
                                const Theta& start) {
  if (filter.coupling != Coupling::lambda || !filter.active[lambda] ||
      filter.priors[lambda].sigma() <= 0.0)
    return fit_batch(filter, timeline, readout, measured, start);
  BatchResult best = fit_batch(filter, timeline, readout, measured, start, patient);
  for (const double end : {0.0, 1.0}) {
    FilterSpec held = filter;
    held.priors[lambda] = fixed(end);
    Theta from = start;
    from[lambda] = end;
    from = theta_of(held, fit_batch(held, timeline, readout, measured, from));
    BatchResult other = fit_batch(filter, timeline, readout, measured, from, patient);
    if (other.estimate.statistic < best.estimate.statistic) best = std::move(other);
  }
  for (ParameterEstimate& p : best.estimate.parameters) p.start = start[p.param];
  return best;
}

}  // namespace drift::equation
