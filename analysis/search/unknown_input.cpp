#include "analysis/search/unknown_input.hpp"

#include "analysis/search/scores/library_prior.hpp"

namespace drift::search {
namespace {

using inference::NoiseEstimate;

/// The white noise that is left beside an input in one equation; the input itself is no noise and
/// is left to be explained.
NoiseEstimate beside(const Fitted& e, const inference::LoneInput& input) {
  inference::NoiseModel with_input = declared_noise(e.filter);
  with_input.lone = input;
  NoiseEstimate left = inference::estimate_noise(e.problem, with_input, {}, 0);
  left.model.lone = {};
  return left;
}

double log_period(const Fitted& e, const inference::NoiseModel& white) {
  return inference::strongest_periodic_input(e.problem,
                                             inference::Projector(e.problem.bare(), white))
      .log_evidence();
}

}  // namespace

WithInput with_input(const Fitted& e, const NoiseEstimate& white, UnknownInputs inputs) {
  const inference::LoneEffect lone = inference::strongest_lone_input(e.problem, white.model);
  const double log_lone = log_free_form(lone, e.problem),
               log_periodic =
                   inputs == UnknownInputs::periodic_too ? log_period(e, white.model) : never;
  if (log_periodic > log_lone) return {white, white.log_evidence() + log_periodic};
  WithInput out{beside(e, lone.input)};
  out.log_evidence = out.noise.log_evidence() + log_price_of_free_form(e.problem);
  return out;
}

}  // namespace drift::search
