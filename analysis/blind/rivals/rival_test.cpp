#include "analysis/blind/rivals/rival.hpp"

#include "analysis/diagnosis/nominal_fit.hpp"
#include "analysis/preparation/prepare.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "core/recording/recording.hpp"

namespace drift::blind {

RivalTest rival_test(const std::string& study_path, const std::string& recording_path) {
  constexpr int bins_per_position = 6;
  const mc::Study given = mc::read_study(study_path);
  const preparation::Prepared p = preparation::prepare(
      given, {read_recording(recording_path, given.recording, given.kind, given.site.gravity)});
  const preparation::RecordedTest recorded = preparation::recorded_test(p.study, p.recordings);
  const FilterSpec& nominal = p.study.filters.front();
  const diagnosis::NominalFit fitted =
      diagnosis::fit_nominal(nominal, {recorded.timeline, p.study.readout, recorded.measured}, {});
  const MeasuredTest test{recorded.timeline, p.study.readout, fitted.measured};
  RivalTest out;
  out.examined = search::examine(nominal, test, fitted.fit);
  out.inputs = diagnosis::estimate_inputs(out.examined.problem, recorded.timeline,
                                          *out.examined.projector, bins_per_position);
  for (std::size_t k = 0; k < out.examined.set.candidates.size(); ++k) {
    const inference::Candidate& c = out.examined.set.candidates[k];
    if (c.params.size() != 1 || c.term == closure_term) continue;
    for (std::size_t v = 0; v < c.variants.size(); ++v)
      if (out.examined.contrasts[k][v].dof > 0)
        out.columns.push_back({c.variants[v].columns.front(), k});
  }
  return out;
}

std::vector<Rival> rivals() {
  return {{"chi-square and Ljung-Box", chi_square_alarm},
          {"correlation, not projected", unprojected_correlation},
          {"STLSQ on recovered rates", thresholded_least_squares},
          {"LASSO and BIC on recovered rates", lasso},
          {"forward selection, Benjamini-Hochberg", forward_selection},
          {"split sample, F", split_sample}};
}

}  // namespace drift::blind
