#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/identification/filter_odds.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/delay_words.hpp"
#include "analysis/report/identify/input_doubts.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/results_out.hpp"
#include "analysis/report/identify/sections.hpp"
#include "analysis/report/identify/turned_words.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/physics/parameters_config.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

std::string verdict_key(double ratio) {
  if (!std::isfinite(ratio)) return "";
  switch (start_verdict(ratio)) {
    case StartVerdict::consistent:
      return "consistent";
    case StartVerdict::doubtful:
      return "doubtful";
    case StartVerdict::depends_on_start:
      return "depends_on_start";
  }
  return "";
}

Json estimator(const EstimateResult& result) {
  Json out;
  out["status"] = status_key(result.status);
  out["cause"] = text_or_null(result.cause);
  const bool measured = result.measured > 0;
  out["degrees_of_freedom"] = result.measured;
  out["chi2_per_dof"] = measured ? result.statistic_per_dof() : std::nan("");
  if (measured) {
    const stats::Band band = stats::chi_square_band(static_cast<double>(result.measured));
    out["chi2_per_dof_95"] = {band.low, band.high};
  }
  Json& all = out["parameters"] = Json::object();
  for (const ParameterEstimate& p : result.parameters) {
    const double unit = unit_of(p.param);
    all[parameter_key(p.param)] = {{"estimate", p.value / unit},
                                   {"sigma", p.sigma / unit},
                                   {"start", p.start / unit},
                                   {"learning_ratio", p.learning_ratio()},
                                   {"unit", parameter_unit(p.param)}};
  }
  return out;
}

/// What the run that counts is as a fit: "ok", "outside_band", "less_noise", "misfit", or why not.
std::string fit_key(const EstimateResult& result) {
  if (result.status != EstimateStatus::ok) return std::string(status_key(result.status));
  if (misfit(result)) return "misfit";
  if (less_noise(result)) return "less_noise";
  return fit_cell(result).tone == Tone::plain ? "ok" : "outside_band";
}

Json run_json(const identification::FilterRun& run) {
  Json out;
  out["start"] = run.start + 1;
  out["ekf"] = estimator(run.ekf);
  out["batch"] = estimator(run.batch.estimate);
  out["batch"]["iterations"] = run.batch.estimate.iterations;
  out["batch"]["data_chi2"] = run.batch.data_chi2;
  return out;
}

Json parameters_json(const identification::FilterSummary& summary,
                     const identification::Identification& id) {
  Json all = Json::object();
  for (std::size_t k = 0; k < summary.layout.size(); ++k) {
    const std::size_t param = summary.layout.params[k];
    const double unit = unit_of(param);
    Json& p = all[parameter_key(param)];
    p["unit"] = parameter_unit(param);
    p["term"] = TermLibrary::owner(param).key;
    if (id.truth) p["truth"] = id.truth->theta[param] / unit;
    p["prior_mean"] = summary.layout.mean[k] / unit;
    p["prior_sigma"] = summary.layout.sigma[k] / unit;
    p["start_consistency"] = {{"ekf", summary.spread[k].ekf},
                              {"batch", summary.spread[k].batch},
                              {"verdict", text_or_null(verdict_key(summary.spread[k].ekf))}};
  }
  return all;
}

Json published_json(const mc::Published& published) {
  Json out;
  out["name"] = published.name;
  out["filter"] = text_or_null(published.filter);
  Json& all = out["parameters"] = Json::object();
  for (const auto& v : published.values) {
    const bool ratio = v.values.size() > 1 && v.sigmas.size() == v.values.size();
    const double r = ratio ? start_consistency(v.values, v.sigmas) : std::nan("");
    Json values = Json::array(), sigmas = Json::array();
    for (const double value : v.values) values.push_back(value / unit_of(v.param));
    for (const double sigma : v.sigmas) sigmas.push_back(sigma / unit_of(v.param));
    all[parameter_key(v.param)] = {{"unit", parameter_unit(v.param)},
                                   {"values", values},
                                   {"sigmas", sigmas},
                                   {"start_consistency", r},
                                   {"verdict", text_or_null(verdict_key(r))}};
  }
  return out;
}

}  // namespace

Json identification_document(const mc::Study& study, const identification::Identification& id) {
  Json out;
  out["schema"] = 1;
  out["study"] = {{"path", study.path}, {"title", study.title}, {"seed", study.monte_carlo.seed}};
  out["simulated"] = id.simulated;
  out["truth_coupling"] = id.simulated ? Json(key_of(study.truth.coupling)) : Json(nullptr);
  out["sources"] = id.sources;
  out["absent_positions"] = id.absent_positions;
  out["absent_channels"] = id.absent;  // of [readout]; the estimates are without them
  add_input(out, id.off_zero, id.spikes);
  out["instants"] = delay_json(id.delay);
  Json& remarks = out["remarks"] = Json::array();
  for (const InputDoubt& doubt : input_doubts(study, id, true)) remarks.push_back(doubt.text);
  for (const std::string& text : id.remarks) remarks.push_back(text);
  const auto evidences = identification::log_evidences(study, id);
  Json& filters = out["filters"] = Json::array();
  for (const identification::FilterSummary& summary : id.summaries) {
    const FilterSpec& spec = study.filters[summary.filter];
    Json f;
    f["name"] = spec.name;
    f["coupling"] = key_of(spec.coupling);
    f["terms"] = term_keys(spec.model().terms);
    f["parameters"] = parameters_json(summary, id);
    Json& starts = f["starts"] = Json::array();
    for (const identification::FilterRun* run : id.runs_of(summary.filter))
      starts.push_back(run_json(*run));
    f["counted_start"] = id.counted(summary).start + 1;
    const EstimateResult& counted = judged({study, id, summary});
    f["fit"] = fit_key(counted);
    const auto& evidence = evidences[filters.size()];  // differences are log odds
    f["log_evidence"] = evidence ? Json(*evidence) : Json(nullptr);
    f["noise_of_declared"] =  // 1 sigma of all rows; null where it is not less than declared
        less_noise(counted) ? Json(identification::noise_of_declared(spec, id.counted(summary)))
                            : Json(nullptr);
    f["agreeing_starts"] = summary.agreeing_starts;  // with it and itself; 0: none converged
    f["beyond_prior"] = beyond_prior({study, id, summary});
    f["heading_doubt"] =
        summary.heading_doubt ? heading_json(*summary.heading_doubt) : Json(nullptr);
    f["latitude_doubt"] = latitude_json(summary.latitude_doubt);
    f["clock_doubt"] = clock_json(summary.latitude_doubt);
    Json& remembered = f["memory_off"] = Json::object();  // rms part of what a term remembers
    for (const MemoryLeftOut& one : id.counted(summary).memory_doubt)
      remembered[one.term] = one.part;
    Json& gaps = f["memory_gaps"] = Json::object();  // over which a term's memory is not known
    for (const identification::MemoryGaps& g : id.counted(summary).memory_gaps)
      gaps[g.widest.term] = {{"from_position", g.widest.from + 1},
                             {"to_position", g.widest.to + 1},
                             {"seconds", g.widest.length},
                             {"left", g.widest.left},
                             {"gaps", g.count},
                             {"recording", g.widest.recording}};
    f["loop_left_out"] =  // numbers of the recordings that state one
        id.leaves_out_loop(spec) ? Json(id.loop->recordings) : Json::array();
    f["field_considered"] = summary.field_considered;  // its error is in the sigmas
    f["weak_directions"] = summary.weak;
    f["degeneracies"] = directions_json(unseen_directions({study, id, summary}));
    filters.push_back(std::move(f));
  }
  Json& published = out["published"] = Json::array();
  for (const mc::Published& p : study.published) published.push_back(published_json(p));
  return out;
}

}  // namespace drift::report
