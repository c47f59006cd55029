#include "analysis/report/diagnosis/json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/diagnosis/words.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;
using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json where_json(const Where& where) {
  Json out;
  Json& channels = out["channels"] = Json::array();
  for (const Share& s : where.channels)
    channels.push_back({{"name", s.name},
                        {"share", number(s.share)},
                        {"sigma", number(s.sigma)},
                        {"chi2_per_dof", number(s.chi2_per_dof)}});
  Json& positions = out["positions"] = Json::array();
  for (const Share& s : where.positions)
    positions.push_back({{"position", s.position},
                         {"share", number(s.share)},
                         {"sigma", number(s.sigma)},
                         {"chi2_per_dof", number(s.chi2_per_dof)}});
  Json& windows = out["windows"] = Json::array();
  for (const ScanHit& w : where.windows) {
    windows.push_back({{"start_s", number(w.start_s)},
                       {"end_s", number(w.end_s)},
                       {"equation", w.equation},
                       {"position", w.position},
                       {"score", number(w.T)},
                       {"p_value", number(w.p_value)}});
    if (const RecordingSpan* r = recording_at(where.recordings, 0.5 * (w.start_s + w.end_s)))
      windows.back().update(Json{{"recording", r->name},
                                 {"start_in_recording_s", number(w.start_s - r->offset_s)},
                                 {"end_in_recording_s", number(w.end_s - r->offset_s)}});
  }
  for (const RecordingSpan& r : where.recordings)
    out["recordings"].push_back({{"name", r.name},
                                 {"start_s", number(r.start_s)},
                                 {"end_s", number(r.end_s)},
                                 {"offset_s", number(r.offset_s)}});
  out["equation"] = text_or_null(where.equation);
  const bool scanned = std::isfinite(where.scan_p_value);
  out["p_value"] = number(where.scan_p_value);
  out["windows_tried"] = scanned ? Json(where.windows_tried) : Json(nullptr);
  return out;
}

Json causes_json(const std::vector<Cause>& causes) {
  Json all = Json::array();
  for (const Cause& c : causes) {
    Json parameters = Json::array(), confusable = Json::array();
    for (const CauseParameter& p : c.parameters)
      parameters.push_back(
          {{"key", p.key},
           {"value", number(p.value)},
           {"sigma", number(p.sigma)},
           {"unit", p.unit},
           {"interval_95", {number(p.value - 1.96 * p.sigma), number(p.value + 1.96 * p.sigma)}},
           {"profiled", p.profiled}});
    for (const Confusable& other : c.confusable_with)
      confusable.push_back({{"term", other.term},
                            {"axis", text_or_null(other.axis)},
                            {"cosine", number(other.cosine)}});
    all.push_back({{"term", c.term},
                   {"axis", text_or_null(c.axis)},
                   {"p_value", number(c.p_value)},
                   {"held_out_gain", number(c.held_out_gain)},
                   {"probability", number(c.probability)},
                   {"parameters", std::move(parameters)},
                   {"confusable_with", std::move(confusable)},
                   {"score", number(c.T)},
                   {"dof", c.dof},
                   {"size_sigma", number(c.size_sigma)},
                   {"set", c.set}});
  }
  return all;
}

Json candidates_json(const std::vector<CandidateScore>& candidates) {
  Json all = Json::array();
  for (const CandidateScore& c : candidates) {
    const bool one = c.sigma > 0.0;  // of several parameters there is no single amplitude
    all.push_back({{"term", c.term},
                   {"score", number(c.score)},
                   {"p_value", number(c.p_value)},
                   {"absorbed", number(c.absorbed)},
                   {"axis", text_or_null(c.axis)},
                   {"label", c.label},
                   {"dof", c.dof},
                   {"p_value_alone", number(c.p_marginal)},
                   {"amplitude", one ? number(c.amplitude) : Json(nullptr)},
                   {"sigma", one ? number(c.sigma) : Json(nullptr)},
                   {"smallest_detectable", one ? number(c.smallest_detectable) : Json(nullptr)},
                   {"unit", text_or_null(c.unit)},
                   {"size_sigma", number(c.size_sigma)},
                   {"log_bayes", number(c.log_bayes)},
                   {"probability", number(c.probability)},
                   {"adequate", c.adequate},
                   {"observable", c.observable}});
  }
  return all;
}

Json folds_json(const std::vector<Fold>& folds) {
  Json list = Json::array();
  for (const Fold& f : folds)
    list.push_back({{"name", f.name},
                    {"positions", f.positions},
                    {"chi2_before", number(f.chi2_before)},
                    {"chi2_after", number(f.chi2_after)},
                    {"dof", f.dof},
                    {"log_score_gain", number(f.log_score_after - f.log_score_before)},
                    {"same_choice", f.same_choice}});
  return list;
}

Json fit_json(const FitComparison& fit, bool has_cause) {
  Json out;
  // Without a cause there is no second fit; a recording on a case has no likelihood.
  const bool refitted = has_cause && std::isfinite(fit.log_likelihood_ratio);
  const auto of_refit = [&](double value) { return refitted ? number(value) : Json(nullptr); };
  out["in_sample"] = {
      {"chi2_per_dof_before", number(fit.chi2_per_dof_before)},
      {"chi2_per_dof_after", number(fit.chi2_per_dof_after)},
      {"chi2_per_dof_95",
       fit.band_high > 0.0 ? Json{number(fit.band_low), number(fit.band_high)} : Json(nullptr)},
      {"dof", fit.dof},
      {"log_likelihood_ratio", of_refit(fit.log_likelihood_ratio)},
      {"predicted_by_score", of_refit(fit.linear_T)},
      {"sign_agrees", refitted ? Json(fit.sign_agrees) : Json(nullptr)},
      {"ljung_box_p_before", number(fit.whiteness.ljung_box_p_before)},
      {"ljung_box_p_after", number(fit.whiteness.ljung_box_p_after)},
      {"nis_per_dof_before", number(fit.whiteness.nis_per_dof_before)},
      {"nis_per_dof_after", number(fit.whiteness.nis_per_dof_after)}};
  const HeldOut& held = fit.held_out;
  const auto of_folds = [&](double value) {
    return held.folds.empty() ? Json(nullptr) : number(value);
  };
  out["held_out"] = {{"chi2_per_dof_before", of_folds(held.chi2_per_dof_before)},
                     {"chi2_per_dof_after", of_folds(held.chi2_per_dof_after)},
                     {"log_score_gain", of_folds(held.log_score_gain)},
                     {"folds", held.folds.size()},
                     {"log_score_gain_sigma", of_folds(held.log_score_gain_sigma)},
                     {"nested_gain", of_folds(held.nested_gain)},
                     {"improves", held.improves},
                     {"method", text_or_null(held.method)},
                     {"each", folds_json(held.folds)}};
  if (!held.recordings.empty())
    out["held_out"]["by_recording"] = {
        {"chi2_per_dof_before", number(held.recording_chi2_per_dof_before)},
        {"chi2_per_dof_after", number(held.recording_chi2_per_dof_after)},
        {"log_score_gain", number(held.recording_gain)},
        {"folds", held.recordings.size()},
        {"each", folds_json(held.recordings)}};
  out["start_spread_before"] = number(fit.start_spread_before);
  out["start_spread_after"] = number(fit.start_spread_after);
  Json& shifted = out["shifted_parameters"] = Json::array();
  for (const ShiftedParameter& p : fit.shifted)
    shifted.push_back({{"key", p.key},
                       {"before", number(p.before)},
                       {"after", number(p.after)},
                       {"sigma_after", number(p.sigma_after)},
                       {"unit", p.unit},
                       {"sigma_before", number(p.sigma_before)},
                       {"shift_sigma", number(p.shift_sigma)}});
  return out;
}

Json plan_json(const std::vector<Position>& plan) {
  Json positions = Json::array();
  for (const Position& p : plan) {
    Json one = Json::object();
    for (const auto& member : position_node(p).members) one[member.key] = member.value.text;
    positions.push_back(std::move(one));
  }
  return {{"position", std::move(positions)}};
}

Json advice_json(const std::vector<Advice>& advice) {
  Json all = Json::array();
  for (const Advice& a : advice)
    all.push_back({{"text", a.text},
                   {"plan", plan_json(a.plan)},
                   {"separates", a.separates},
                   {"expected_sigma", number(a.expected_sigma)},
                   {"now_sigma", number(a.now_sigma)},
                   {"verified_sigma", number(a.verified_sigma)}});
  return all;
}

Json noise_json(const std::vector<NoiseFinding>& noise) {
  Json all = Json::array();
  for (const NoiseFinding& n : noise)
    all.push_back({{"component", n.component},
                   {"factor", number(n.factor)},
                   {"factor_sigma", number(n.factor_sigma)},
                   {"value", number(n.value)},
                   {"unit", text_or_null(n.unit)},
                   {"tau_s", n.tau_s > 0.0 ? number(n.tau_s) : Json(nullptr)},
                   {"log_likelihood_gain", number(n.log_likelihood_gain)},
                   {"p_value", number(n.p_value)},
                   {"significant", n.significant},
                   {"count", n.count}});
  return all;
}

/// What the recovered input says of each equation; the series itself is in residual_signal.csv.
Json equations_json(const std::vector<RecoveredSignal>& signals) {
  Json all = Json::array();
  for (const RecoveredSignal& s : signals)
    all.push_back(
        {{"equation", s.equation},
         {"unit", s.unit},
         {"shape", s.shape},
         {"onset_s", s.onset_s >= 0.0 ? number(s.onset_s) : Json(nullptr)},
         {"period_s", s.period_s > 0.0 ? number(s.period_s) : Json(nullptr)},
         {"covariate", text_or_null(s.best_covariate)},
         {"correlation", s.best_covariate.empty() ? Json(nullptr) : number(s.correlation)}});
  return all;
}

Json cosines_json(const CosineMatrix& cosines) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < cosines.cosine.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < cosines.cosine.cols(); ++j)
      row.push_back(number(cosines.cosine(i, j)));
    rows.push_back(std::move(row));
  }
  return {{"labels", cosines.labels}, {"cosine", std::move(rows)}};
}

}  // namespace

std::string to_json(const Diagnosis& d) {
  Json out;
  out["schema"] = 1;
  out["verdict"] = std::string(text(d.verdict));
  out["p_value"] = number(d.p_value);
  out["sentence"] = d.sentence;
  out["other_equation_gain"] = number(d.other_equation_gain);
  out["where"] = where_json(d.where);
  out["causes"] = causes_json(d.causes);
  out["candidates"] = candidates_json(d.candidates);
  out["fit"] = fit_json(d.fit, d.has_patch);
  out["advice"] = advice_json(d.advice);
  out["model"] = d.has_patch ? Json("patched.toml") : Json(nullptr);
  out["noise"] = noise_json(d.noise);
  out["equations"] = equations_json(d.signals);
  out["cosines"] = cosines_json(d.cosines);
  out["inseparable"] = d.inseparable;
  out["remarks"] = remarks_of(d);
  Json& seconds = out["seconds"] = Json::object();
  for (const auto& [stage, time] : d.seconds) seconds[stage] = number(time);
  // Names are free text; bytes that are not UTF-8 become U+FFFD instead of an exception.
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace drift::report
