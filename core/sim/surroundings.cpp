#include "core/sim/surroundings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/check.hpp"
#include "core/physics/own/own_terms.hpp"

namespace drift {
namespace {

/// Where a covariate may come from: "a column temperature [degC] with numbers in the recording;
/// ...".
std::string expected(const CovariateSpec& c) {
  if (!c.is_vector())
    return fmt::format(
        "a column {} [{}] with numbers in the recording; for a simulated or planned test, {} = {} "
        "in "
        "[environment]",
        c.name, c.unit.symbol.view(), c.name, c.example);
  return fmt::format("columns {} in the recording, or the same keys in [environment] of the study",
                     columns_in_words(c));
}

/// " in b.csv" of several recordings of which others have what is wanted.
std::string lacking_in_words(const Timeline& timeline, CovariateSet wanted) {
  std::string out;
  for (const std::size_t k : timeline.lacking(wanted))
    out += (out.empty() ? " in " : ", ") + timeline.recordings[k].name;
  return out;
}

/// What a compensated loop removed, of recordings that do not tell it; empty: known, or not asked
/// for.
std::string missing_loop(const DriftModel& model, const Timeline& timeline) {
  if (model.coupling != Coupling::compensated || timeline.without_loop.empty()) return "";
  return fmt::format(
      "coupling \"compensated\" needs the misalignments that the loop removed, which are not known "
      "in {} (expected columns loop_eta_x, loop_eta_y, loop_eta_z, loop_xi_x, loop_xi_y, loop_xi_z "
      "[arcsec]; [truth.loop] is of simulations). Add them, 0 where it removed nothing, or choose "
      "another coupling",
      fmt::join(timeline.without_loop, ", "));
}

}  // namespace

std::string columns_in_words(const CovariateSpec& c) {
  std::string names;
  for (std::size_t k = 0; k < c.components(); ++k)
    names += (k == 0 ? "" : ", ") + std::string(c.column(k).view());
  return fmt::format("{} [{}]", names, c.unit.symbol.view());
}

std::vector<std::string> missing_covariates(const DriftModel& model, const Timeline& timeline) {
  std::vector<std::string> messages;
  if (std::string loop = missing_loop(model, timeline); !loop.empty())
    messages.push_back(std::move(loop));
  if (timeline.carries(TermLibrary::needs(model.terms))) return messages;
  for (std::size_t t = 0; t < TermLibrary::num_terms; ++t) {
    const TermInfo& term = TermLibrary::terms[t];
    if (!model.terms[t]) continue;
    const CovariateSet missing = term.needs.covariates & ~timeline.carried;
    for (const CovariateSpec& c : known_covariates)
      if ((missing & c.set()) != 0)
        messages.push_back(
            fmt::format("term '{}' needs the {}, which is not known{} (expected {}). Add it, or "
                        "remove the term",
                        term.key, c.what, lacking_in_words(timeline, c.set()), expected(c)));
    if (term.needs.turning && !timeline.reads_turns)
      messages.push_back(fmt::format(
          "term '{}' needs accelerometers that are read while the case turns (expected a strapdown "
          "study with accelerometers_in_turns = true in [plan], and gyros that see the Earth). Set "
          "it, or remove the term",
          term.key));
    for (std::size_t k = 0; k < own_terms().covariates.size(); ++k)
      if ((missing & further_column(k)) != 0)
        messages.push_back(fmt::format(
            "term '{}' needs '{}', which is not known{} (expected a column of that name with "
            "numbers in the recording; a simulated or planned test has none). Add it, or remove "
            "the term",
            term.key, own_terms().covariates[k], lacking_in_words(timeline, further_column(k))));
  }
  return messages;
}

void require_covariates(const DriftModel& model, const Timeline& timeline) {
  if (const auto messages = missing_covariates(model, timeline); !messages.empty())
    throw InputError(ExitCode::recording, messages);
}

}  // namespace drift
