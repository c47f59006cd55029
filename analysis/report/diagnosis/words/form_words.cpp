#include "analysis/report/diagnosis/words/form_words.hpp"

#include <fmt/format.h>

#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"

namespace drift::report {

using namespace diagnosis;

namespace {

/// The term of the library that a form is, on this plan: ", which on this plan is magnetic
/// sensitivity, gyro y (magnetic_drift.y: M_y)". Empty: none.
std::string known_text(const Proposal& p) {
  const auto param = TermLibrary::find(p.known);
  if (!param) return "";
  const TermInfo& term = TermLibrary::owner(*param);
  const std::string_view axis = TermLibrary::specs[*param].axis;
  return fmt::format(", which on this plan is {} ({}: {})", in_words(term.key, axis),
                     search::keyed(term.key, axis), p.known);
}

std::string what_to_do_text(const Proposal& p) {
  return p.known.empty() ? ""
         : p.in_nominal
             ? " The nominal model has that term, under a prior that keeps it from this size."
             : " Use that term, under a prior as wide as this, in its place.";
}

}  // namespace

std::string form_sentence(const Proposal& p) {
  std::vector<std::string> numbers;
  for (const search::CauseParameter& parameter : p.parameters)
    numbers.push_back(fmt::format("{} = {} {}", parameter.key.substr(parameter.key.rfind('_') + 1),
                                  parameter.sigma > 0.0
                                      ? with_sigma(parameter.value, parameter.sigma)
                                      : number_text(parameter.value),
                                  parameter.unit));
  return fmt::format(
      "A form that fits, not a cause: {} += {}{}, with {}.{} Of {} positions, each held out of the "
      "fit, "
      "chi-square per degree of freedom goes from {:.3g} to {:.3g} (log score {:+.3g}); of {} "
      "forms "
      "tried, noise alone gives one as much with a chance of {}.",
      p.acts_on, p.equation, known_text(p), listed(numbers, "and"), what_to_do_text(p), p.positions,
      p.chi2_per_dof_before, p.chi2_per_dof_after, p.held_out_gain, p.forms, p_text(p.p_value));
}

}  // namespace drift::report
