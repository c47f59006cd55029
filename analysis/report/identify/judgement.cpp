#include "analysis/report/identify/judgement.hpp"

#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

std::string misfit_text(const FilterView& v) {
  const EstimateResult& result = judged(v);
  return result.status != EstimateStatus::ok
             ? "did not converge"
             : fmt::format("misfits (chi-square per degree of freedom {}, 1 expected)",
                           number_text(result.statistic_per_dof()));
}

}  // namespace

std::string outside_text(const FilterView& v) {
  const EstimateResult& result = judged(v);
  if (!believed(v) || fit_cell(result).tone == Tone::plain) return "";
  const auto dof = static_cast<double>(result.measured);
  const stats::Band band = stats::chi_square_band(dof);
  return fmt::format(
      "Filter {}: chi-square per degree of freedom {:.3f} is outside the 95 % band of a right "
      "model, {:.3f} to {:.3f} (so far by chance: {:.1g}): a small effect is missing, or noise and "
      "priors are not what the study says.",
      v.spec().name, result.statistic_per_dof(), band.low, band.high,
      stats::chi_square_chance(result.statistic_per_dof(), dof));
}

Judgement judgement_of(const mc::Study& study, const identification::Identification& id) {
  Judgement j;
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView v{study, id, s};
    if (!believed(v)) {
      j.bad.push_back(fmt::format("filter {} {}", v.spec().name, misfit_text(v)));
      continue;
    }
    j.good.push_back(v.spec().name);
    if (!outside_text(v).empty()) j.nearly.push_back(v.spec().name);
    if (s.filter == 0) {
      j.first_fits = true;
      j.first_far = far_from_prior(v);
    }
    for (std::size_t k = 0; k < s.layout.size(); ++k) {
      const Worth worth = verdict_of(v, k).worth;
      j.wrong = j.wrong || worth == Worth::wrong;
      j.unlearned = j.unlearned || worth == Worth::prior_only || worth == Worth::sum_only;
    }
  }
  return j;
}

std::optional<identification::LatitudeDoubt> other_latitude(
    const identification::Identification& id) {
  for (const identification::FilterSummary& s : id.summaries)
    if (s.latitude_doubt) return s.latitude_doubt;
  return std::nullopt;
}

const identification::HeadingDoubt* other_headings(const identification::Identification& id) {
  for (const identification::FilterSummary& s : id.summaries)
    if (s.heading_doubt) return &*s.heading_doubt;
  return nullptr;
}

}  // namespace drift::report
