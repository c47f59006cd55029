#include "analysis/report/identify/judgement.hpp"

#include <algorithm>

#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

std::string chi2_text(const FilterView& v) {
  return "chi-square per degree of freedom " + number_text(judged(v).statistic_per_dof());
}

std::string misfit_text(const FilterView& v) {
  return judged(v).status != EstimateStatus::ok
             ? "did not converge"
             : fmt::format("misfits ({}, 1 expected)", chi2_text(v));
}

/// "0.49 times what [readout] declares from filter a (chi-square ...)"
std::string less_noise_text(const FilterView& v) {
  return fmt::format(
      "{} times what [readout] declares from filter {} ({}, 1 expected)",
      number_text(identification::noise_of_declared(v.spec(), v.id.counted(v.summary))),
      v.spec().name, chi2_text(v));
}

/// Parameters of combinations that no position of a laboratory shows.
ParamMask hidden_anywhere(const FilterView& v) {
  ParamMask hidden;
  if (root_of(v).size() == 0) return hidden;
  for (const NamedDirection& d : unseen_directions(v))
    for (const NamedDirection::Part& part : d.parts)
      if (d.anywhere) hidden.set(part.param);
  return hidden;
}

}  // namespace

std::string outside_text(const FilterView& v) {
  const EstimateResult& result = judged(v);
  if (!believed(v) || less_noise(result) || fit_cell(result).tone == Tone::plain) return "";
  const auto dof = static_cast<double>(result.measured);
  const double per_dof = result.statistic_per_dof();
  const stats::Band band = stats::chi_square_band(dof);
  // Whatever is missing makes chi-square larger, never smaller.
  return fmt::format(
      "Filter {}: chi-square per degree of freedom {:.3f} is outside the 95 % band of a right "
      "model, {:.3f} to {:.3f} (so far by chance: {:.1g}): {}.",
      v.spec().name, per_dof, band.low, band.high, stats::chi_square_chance(per_dof, dof),
      per_dof > 1.0 ? "a small effect is missing, or noise and priors are not what the study says"
                    : "noise is less, or priors are narrower, than the study says, and sigmas are "
                      "somewhat too "
                      "wide");
}

Judgement judgement_of(const mc::Study& study, const identification::Identification& id) {
  Judgement j;
  std::vector<std::size_t> good;
  for (std::size_t which = 0; which < id.summaries.size(); ++which) {
    const identification::FilterSummary& s = id.summaries[which];
    const FilterView v{study, id, s};
    if (!believed(v)) {
      j.bad.push_back(fmt::format("filter {} {}", v.spec().name, misfit_text(v)));
      continue;
    }
    good.push_back(which);
    j.good.push_back(v.spec().name);
    const bool less = less_noise(judged(v));
    if (less)
      j.less_noise.push_back(less_noise_text(v));
    else
      j.leave_more.push_back(
          fmt::format("filter {} leaves more ({})", v.spec().name, chi2_text(v)));
    if (!outside_text(v).empty()) j.nearly.push_back(v.spec().name);
    if (s.filter == 0) {
      j.first_fits = true;
      j.first_less_noise = less;
      j.first_far = far_from_prior(v);
    }
    const ParamMask hidden = s.filter == 0 ? hidden_anywhere(v) : ParamMask();
    for (std::size_t k = 0; k < s.layout.size(); ++k) {
      const Worth worth = verdict_of(v, k).worth;
      j.wrong = j.wrong || worth == Worth::wrong;
      const bool lacking = worth == Worth::prior_only || worth == Worth::sum_only;
      j.unlearned = j.unlearned || (lacking && s.filter == 0 && !hidden[s.layout.params[k]]);
    }
  }
  j.favoured = identification::favoured(study, id, good);
  j.first_favoured = !j.favoured || std::ranges::find(j.favoured->filters, std::size_t{0}) !=
                                        j.favoured->filters.end();
  if (j.less_noise.empty()) j.leave_more.clear();
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
