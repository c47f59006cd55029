#include "analysis/report/identify/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/page/degeneracies.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/physics/coupling_text.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json numbers(const std::vector<double>& values, double unit) {
  Json all = Json::array();
  for (const double v : values) all.push_back(number(v / unit));
  return all;
}

std::string text(std::string_view view) {
  return std::string(view);
}

const char* status_key(EstimateStatus status) {
  switch (status) {
    case EstimateStatus::ok:
      return "ok";
    case EstimateStatus::not_converged:
      return "not_converged";
    case EstimateStatus::diverged:
      return "diverged";
  }
  return "";
}

const char* verdict_key(double ratio) {
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

Json verdict(double ratio) {
  return std::isfinite(ratio) ? Json(verdict_key(ratio)) : Json(nullptr);
}

Json estimator(const EstimateResult& result) {
  Json out;
  out["status"] = status_key(result.status);
  out["cause"] = result.cause.empty() ? Json(nullptr) : Json(result.cause);
  const bool measured = result.measured > 0;
  out["degrees_of_freedom"] = result.measured;
  out["chi2_per_dof"] = measured ? number(result.statistic_per_dof()) : Json(nullptr);
  if (measured) {
    const stats::Band band = stats::chi_square_band(static_cast<double>(result.measured));
    out["chi2_per_dof_95"] = {number(band.low), number(band.high)};
  }
  Json& all = out["parameters"] = Json::object();
  for (const ParameterEstimate& p : result.parameters) {
    const auto& spec = TermLibrary::specs[p.param];
    const double unit = spec.unit.to_si;
    all[text(spec.key)] = {{"estimate", number(p.value / unit)},
                           {"sigma", number(p.sigma / unit)},
                           {"start", number(p.start / unit)},
                           {"learning_ratio", number(p.learning_ratio())},
                           {"unit", text(spec.unit.symbol)}};
  }
  return out;
}

Json run_json(const identification::FilterRun& run) {
  Json out;
  out["start"] = run.start + 1;
  out["ekf"] = estimator(run.ekf);
  out["batch"] = estimator(run.batch.estimate);
  out["batch"]["iterations"] = run.batch.estimate.iterations;
  out["batch"]["data_chi2"] = number(run.batch.data_chi2);
  return out;
}

Json parameters_json(const identification::FilterSummary& summary,
                     const identification::Identification& id) {
  Json all = Json::object();
  for (std::size_t k = 0; k < summary.layout.size(); ++k) {
    const auto& spec = TermLibrary::specs[summary.layout.params[k]];
    const double unit = spec.unit.to_si;
    Json& p = all[text(spec.key)];
    p["unit"] = text(spec.unit.symbol);
    p["term"] = text(TermLibrary::owner(summary.layout.params[k]).key);
    if (id.truth) p["truth"] = number(id.truth->theta[summary.layout.params[k]] / unit);
    p["prior_mean"] = number(summary.layout.mean[k] / unit);
    p["prior_sigma"] = number(summary.layout.sigma[k] / unit);
    p["start_consistency"] = {{"ekf", number(summary.spread[k].ekf)},
                              {"batch", number(summary.spread[k].batch)},
                              {"verdict", verdict(summary.spread[k].ekf)}};
  }
  return all;
}

Json degeneracies_json(const FilterSpec& filter, const identification::FilterSummary& summary) {
  Json all = Json::array();
  for (const NamedDirection& d :
       name_degeneracies(summary.layout, filter.mounting, summary.degeneracies)) {
    Json parts = Json::object();
    for (const auto& part : d.parts)
      parts[text(TermLibrary::specs[part.param].key)] = number(part.coefficient);
    all.push_back({{"combination", d.combination},
                   {"coefficients", parts},
                   {"reason", d.reason.empty() ? Json(nullptr) : Json(d.reason)}});
  }
  return all;
}

Json published_json(const mc::Published& published) {
  Json out;
  out["name"] = published.name;
  out["filter"] = published.filter.empty() ? Json(nullptr) : Json(published.filter);
  Json& all = out["parameters"] = Json::object();
  for (const auto& v : published.values) {
    const auto& spec = TermLibrary::specs[v.param];
    const bool ratio = v.values.size() > 1 && v.sigmas.size() == v.values.size();
    const double r = ratio ? start_consistency(v.values, v.sigmas) : std::nan("");
    all[text(spec.key)] = {{"unit", text(spec.unit.symbol)},
                           {"values", numbers(v.values, spec.unit.to_si)},
                           {"sigmas", numbers(v.sigmas, spec.unit.to_si)},
                           {"start_consistency", number(r)},
                           {"verdict", verdict(r)}};
  }
  return out;
}

}  // namespace

std::string to_json(const mc::Study& study, const identification::Identification& id) {
  Json out;
  out["schema"] = 1;
  out["study"] = {{"path", study.path}, {"title", study.title}, {"seed", study.monte_carlo.seed}};
  out["simulated"] = id.simulated;
  out["truth_coupling"] = id.simulated ? Json(text(key_of(study.truth.coupling))) : Json(nullptr);
  out["sources"] = id.sources;
  Json& filters = out["filters"] = Json::array();
  for (const identification::FilterSummary& summary : id.summaries) {
    const FilterSpec& spec = study.filters[summary.filter];
    Json f;
    f["name"] = spec.name;
    f["coupling"] = text(key_of(spec.coupling));
    f["terms"] = term_keys(spec.model().terms);
    f["parameters"] = parameters_json(summary, id);
    Json& starts = f["starts"] = Json::array();
    for (const identification::FilterRun* run : id.runs_of(summary.filter))
      starts.push_back(run_json(*run));
    f["weak_directions"] = summary.weak;
    f["degeneracies"] = degeneracies_json(spec, summary);
    filters.push_back(std::move(f));
  }
  Json& published = out["published"] = Json::array();
  for (const mc::Published& p : study.published) published.push_back(published_json(p));
  // Names are free text; bytes that are not UTF-8 become U+FFFD instead of an exception.
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace drift::report
