#include "analysis/report/diagnosis/form_words.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/effect_words.hpp"
#include "analysis/report/diagnosis/sections.hpp"
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

Section form_that_fits(const Diagnosis& d) {
  if (!d.proposal) return {};
  return {"A form that fits",
          {Paragraph{form_sentence(*d.proposal)},
           Paragraph{"As a term of the study file, to be simulated, estimated and tried on another "
                     "recording:"},
           Preformatted{d.proposal->text}},
          On::both};
}

Json form_json(const std::optional<Proposal>& proposal) {
  if (!proposal) return nullptr;
  const Proposal& p = *proposal;
  Json parameters = Json::array();
  for (const search::CauseParameter& parameter : p.parameters)
    parameters.push_back({{"key", parameter.key},
                          {"value", parameter.value},
                          {"sigma", parameter.sigma},
                          {"unit", parameter.unit}});
  return {{"acts_on", p.acts_on},
          {"equation", p.equation},
          {"known", text_or_null(p.known)},
          {"parameters", std::move(parameters)},
          {"p_value", p.p_value},
          {"forms_tried", p.forms},
          {"held_out",
           {{"folds", p.positions},
            {"log_score_gain", p.held_out_gain},
            {"chi2_per_dof_before", p.chi2_per_dof_before},
            {"chi2_per_dof_after", p.chi2_per_dof_after}}}};
}

}  // namespace drift::report
