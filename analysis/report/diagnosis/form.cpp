#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/form_words.hpp"

namespace drift::report {

using namespace diagnosis;

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
