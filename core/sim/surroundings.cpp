#include "core/sim/surroundings.hpp"

#include <fmt/format.h>

#include "core/base/check.hpp"
#include "core/physics/own/own_terms.hpp"

namespace drift {

std::vector<std::string> missing_covariates(const DriftModel& model, const Timeline& timeline) {
  std::vector<std::string> messages;
  if (timeline.carries(TermLibrary::needs(model.terms))) return messages;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (!model.terms[t]) continue;
    if (term.needs.temperature && !timeline.has_temperature)
      messages.push_back(fmt::format(
          "term '{}' needs the temperature, which is not known (expected a column temperature "
          "[degC] "
          "with numbers in the recording; for a simulated one, temperature = \"20 degC\" in "
          "[environment]). Add it, or remove the term",
          term.key));
    if (term.needs.turning && !timeline.reads_turns)
      messages.push_back(fmt::format(
          "term '{}' needs accelerometers that are read while the case turns (expected a strapdown "
          "study with accelerometers_in_turns = true in [plan], and gyros that see the Earth). Set "
          "it, or remove the term",
          term.key));
    for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
      if ((term.needs.covariates & ~timeline.has_further) >> k & 1u)
        messages.push_back(fmt::format(
            "term '{}' needs '{}', which is not known (expected a column of that name with numbers "
            "in the recording; a simulated one has none). Add it, or remove the term",
            term.key, own_terms().covariates[k]));
    if (term.needs.field && !timeline.has_field)
      messages.push_back(
          fmt::format("term '{}' needs the magnetic field, which is not known (expected columns "
                      "field_n, field_w, "
                      "field_u [gauss] in the recording, or the same keys in [environment] of the "
                      "study). Add it, "
                      "or remove the term",
                      term.key));
  }
  return messages;
}

void require_covariates(const DriftModel& model, const Timeline& timeline) {
  if (const auto messages = missing_covariates(model, timeline); !messages.empty())
    throw InputError(ExitCode::recording, messages);
}

}  // namespace drift
