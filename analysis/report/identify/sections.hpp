#pragma once

#include <limits>

#include "analysis/report/identify/report.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

using identification::less_noise;
using identification::misfit;

/// A filter and what it found.
struct FilterView {
  const mc::Study& study;
  const identification::Identification& id;
  const identification::FilterSummary& summary;

  const FilterSpec& spec() const { return study.filters[summary.filter]; }
  /// "legacy (eq6)"
  std::string name() const { return fmt::format("{} ({})", spec().name, key_of(spec().coupling)); }
};

/// What is said of each filter, in this order.
DRIFT_SECTIONS(FilterView, filter_sections, (against_prior, evidence), (filter_model, details),
               (fits, how_sure), (estimates, details), (correlations, details), (unseen, details));

/// Estimates against time from every start, with their sigma bands and the truth or an independent
/// test as a line: all filters together (estimates.svg) and each alone (figure_<filter>.svg, a file
/// alone); and the EKF's NIS per measured scalar with its 95 % band (nis.svg).
Section estimate_figures(const mc::Study& study, const identification::Identification& id);

/// Results of [[published]] beside ours, for every parameter: the published runs, our runs by EKF
/// and batch, the truth, and independent tests (published without a filter). One table for each set
/// of published filter runs, and for each other filter and independent test. Empty if nothing is
/// published.
std::vector<Table> published_comparison(const mc::Study& study,
                                        const identification::Identification& id);

/// What a reader must not miss: which filter depends on its start, whose residuals are not what it
/// believes, what did not converge, what cannot be seen. One sentence each.
std::vector<std::string> headlines(const mc::Study& study,
                                   const identification::Identification& id);

/// Where the batch fit is what a right model gives and the EKF is not, or far from it: that the
/// batch fit counts. Empty elsewhere, and with process noise, which the EKF alone knows.
std::string which_counts(const FilterView& view);

/// Where not the first of several starts counts, or others do not agree with it: which one does,
/// why, and how many agree. Empty elsewhere, and where none converged.
std::string other_start_text(const FilterView& view);

/// That the magnetic field was assumed and its error is in the sigmas; empty elsewhere.
std::string considered_text(const FilterView& view);

/// That terms of the filter have a memory which the platform's own path would leave otherwise;
/// empty elsewhere.
std::string remembered_text(const FilterView& view);

/// Library indices of the parameters worth a picture: the published ones; else those the study
/// gives a true value of its own (at most 6); else the 3 that depend most on the start.
std::vector<std::size_t> highlighted_parameters(const mc::Study& study,
                                                const identification::Identification& id);

/// What an estimate is worth, the gravest objection first.
enum class Worth {
  wrong,            ///< by more than five of its sigmas, where the truth is known
  untrusted,        ///< the fit does not explain the data, or did not converge
  prior_only,       ///< nothing was learned
  sum_only,         ///< the data know a combination of it with others alone
  start_dependent,  ///< another start gives another answer
  learned
};
struct ParameterVerdict {
  std::size_t param = 0;  ///< index in TermLibrary
  Worth worth = Worth::learned;
  double off = std::numeric_limits<double>::quiet_NaN();  ///< from the truth [sigma]
};

/// Whether the filter's estimates explain the data: converged, and no misfit.
bool believed(const FilterView& view);

/// Of a state of the filter's layout: by the batch fit, or by the EKF where process noise is
/// declared.
ParameterVerdict verdict_of(const FilterView& view, std::size_t state);
Cell verdict_cell(const ParameterVerdict& verdict);

/// Which filter to believe, what its parameters are worth, what to do next.
InBrief identification_in_brief(const mc::Study& study, const identification::Identification& id);

/// Verdict on a start-consistency ratio as a cell: "starts agree", "doubtful", "depends on start".
/// "-" where there is no ratio.
Cell verdict_cell(double ratio);

/// What is believed of a filter.
inline const EstimateResult& judged(const FilterView& v) {
  return identification::judged(v.spec(), v.id.counted(v.summary));
}

/// The information of the data by which that is judged that the test does not see.
inline const MatX& root_of(const FilterView& v) {
  return v.id.runs_of(v.summary.filter).front()->batch.information_root;
}
inline std::vector<NamedDirection> unseen_directions(const FilterView& v) {
  return name_degeneracies(v.summary.layout, v.spec().mounting,
                           {v.summary.unseen, root_of(v), v.id.excitation, v.spec().coupling});
}

/// What a fit is worth by its chi-square alone: "ok" inside the 95 % band of a right model,
/// "outside the band" beyond it, "misfit" above and "less noise" below where any right model is.
Cell fit_cell(const EstimateResult& result);

/// Keys of parameters that a filter takes further from their priors than these allow
/// (FitLimits::beyond_prior), the farthest first.
std::vector<std::string> beyond_prior(const FilterView& view);

Json identification_document(const mc::Study& study, const identification::Identification& id);

}  // namespace drift::report
