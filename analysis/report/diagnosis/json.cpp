#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/identification/absent_channels.hpp"
#include "analysis/planning/position_toml.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/advice_words.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/field_words.hpp"
#include "analysis/report/diagnosis/words/not_examined_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/input_doubts.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/turned_words.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

/// How much of the misfit a channel or a position has.
Json share_json(const Share& s) {
  return {{"share", s.share}, {"sigma", s.sigma}, {"chi2_per_dof", s.chi2_per_dof}};
}

Json where_json(const Where& where) {
  Json out;
  Json& channels = out["channels"] = Json::array();
  for (const Share& s : where.channels) {
    channels.push_back({{"name", s.name}});
    channels.back().update(share_json(s));
  }
  Json& positions = out["positions"] = Json::array();
  for (const Share& s : where.positions) {
    positions.push_back({{"position", s.position}});
    positions.back().update(share_json(s));
  }
  out["windows"] = rows_json(
      window_table(where),
      where.recordings.empty()
          ? "start_s end_s equation position score p_value"
          : "start_s end_s equation position score p_value recording start_in_recording_s "
            "end_in_recording_s");
  for (const RecordingSpan& r : where.recordings)
    out["recordings"].push_back(
        {{"name", r.name}, {"start_s", r.start_s}, {"end_s", r.end_s}, {"offset_s", r.offset_s}});
  out["equation"] = text_or_null(where.equation);
  if (!where.equations.empty()) out["equations"] = where.equations;
  const bool scanned = std::isfinite(where.scan_p_value);
  out["p_value"] = where.scan_p_value;
  out["windows_tried"] = scanned ? Json(where.windows_tried) : Json(nullptr);
  return out;
}

Json causes_json(const std::vector<Cause>& causes) {
  Json all = Json::array();
  for (const Cause& c : causes) {
    Json parameters = Json::array(), confusable = Json::array();
    for (const CauseParameter& p : c.parameters)
      parameters.push_back({{"key", p.key},
                            {"value", p.told()},
                            {"sigma", p.told_sigma()},
                            {"unit", p.unit},
                            {"interval_95", {p.low(), p.high()}},
                            {"top", p.top},
                            {"any_of", p.any_of},
                            {"profiled", p.profiled},
                            {"prior_sigmas", p.prior_sigmas},
                            {"note", text_or_null(note_in_words(p))}});
    for (const Confusable& other : c.confusable_with)
      confusable.push_back(
          {{"term", other.term}, {"axis", text_or_null(other.axis)}, {"cosine", other.cosine}});
    all.push_back({{"term", c.term},
                   {"axis", text_or_null(c.axis)},
                   {"p_value", c.p_value},
                   {"held_out_gain", c.held_out_gain},
                   {"probability", c.probability},
                   {"parameters", std::move(parameters)},
                   {"confusable_with", std::move(confusable)},
                   {"score", c.T},
                   {"dof", c.dof},
                   {"size_sigma", c.size_sigma},
                   {"set", c.set}});
  }
  return all;
}

Json folds_json(const std::vector<Fold>& folds, const std::vector<RecordingSpan>& recordings) {
  Json list = Json::array();
  for (const Fold& f : folds)
    list.push_back({{"name", fold_name(f, recordings)},
                    {"positions", f.positions},
                    {"chi2_before", f.chi2_before},
                    {"chi2_after", f.chi2_after},
                    {"dof", f.dof},
                    {"log_score_gain", f.log_score_after - f.log_score_before},
                    {"same_choice", f.same_choice}});
  return list;
}

Json not_examined_json(const Diagnosis& d) {
  Json all = Json::array();
  for (const NotExamined& n : d.not_examined) {
    Json twins = Json::array();
    for (const NamedEffect& twin : n.twins) twins.push_back(twin.label);
    all.push_back({{"term", n.term},
                   {"why", reason_in_words(n, d.where.recordings)},
                   {"twins", std::move(twins)}});
  }
  return all;
}

Json probabilities_json(const Probabilities& p) {
  if (!p.known()) return nullptr;
  Json named = Json::array();
  for (const Probabilities::Explanation& e : p.named) {
    Json causes = Json::array();
    for (const NamedEffect& c : e.causes)
      causes.push_back({{"term", c.term}, {"axis", text_or_null(c.axis)}, {"label", c.label}});
    named.push_back({{"causes", std::move(causes)},
                     {"probability", e.probability},
                     {"other_priors", e.other_priors}});
  }
  return {{"consistent", p.consistent},     {"noise_only", p.noise_only},
          {"named", std::move(named)},      {"outside", p.outside},
          {"wrong_priors", p.wrong_priors}, {"other_priors", p.other_priors}};
}

Json fit_json(const Diagnosis& d) {
  const FitComparison& fit = d.fit;
  Json out;
  // Without a cause there is no second fit; a recording on a case has no likelihood.
  const bool refitted = d.has_patch && std::isfinite(fit.log_likelihood_ratio);
  const auto of_refit = [&](double value) { return refitted ? value : std::nan(""); };
  out["in_sample"] = {
      {"chi2_per_dof_before", fit.chi2_per_dof_before},
      {"chi2_per_dof_after", fit.chi2_per_dof_after},
      {"chi2_per_dof_95", fit.band_high > 0.0 ? Json{fit.band_low, fit.band_high} : Json(nullptr)},
      {"dof", fit.dof},
      {"log_likelihood_ratio", of_refit(fit.log_likelihood_ratio)},
      {"predicted_by_score", of_refit(fit.linear_T)},
      {"sign_agrees", refitted ? Json(fit.sign_agrees) : Json(nullptr)},
      {"ljung_box_p_before", fit.whiteness.ljung_box_p_before},
      {"ljung_box_p_after", fit.whiteness.ljung_box_p_after},
      {"nis_per_dof_before", fit.whiteness.nis_per_dof_before},
      {"nis_per_dof_after", fit.whiteness.nis_per_dof_after}};
  const HeldOut& held = fit.held_out;
  const auto of_folds = [&](double value) { return held.folds.empty() ? std::nan("") : value; };
  out["held_out"] = {{"chi2_per_dof_before", of_folds(held.chi2_per_dof_before)},
                     {"chi2_per_dof_after", of_folds(held.chi2_per_dof_after)},
                     {"log_score_gain", of_folds(held.log_score_gain)},
                     {"folds", held.folds.size()},
                     {"log_score_gain_sigma", of_folds(held.log_score_gain_sigma)},
                     {"nested_gain", of_folds(held.nested_gain)},
                     {"improves", held.improves},
                     {"method", text_or_null(held.method)},
                     {"each", folds_json(held.folds, d.where.recordings)}};
  if (!held.recordings.empty())
    out["held_out"]["by_recording"] = {{"chi2_per_dof_before", held.recording_chi2_per_dof_before},
                                       {"chi2_per_dof_after", held.recording_chi2_per_dof_after},
                                       {"log_score_gain", held.recording_gain},
                                       {"disagrees", held.recordings_disagree},
                                       {"folds", held.recordings.size()},
                                       {"each", folds_json(held.recordings, d.where.recordings)}};
  out["start_spread_before"] = fit.start_spread_before;
  out["start_spread_after"] = fit.start_spread_after;
  out["shifted_parameters"] = rows_json(moved_table(d));
  return out;
}

Json plan_json(const std::vector<Position>& plan) {
  Json positions = Json::array();
  for (const Position& p : plan) {
    Json one = Json::object();
    for (const auto& [key, at, value] : planning::position_node(p).members) {
      one[key] = value.text;
      if (value.items.empty()) continue;
      one[key] = Json::array();
      for (const auto& item : value.items) one[key].push_back(item.text);
    }
    positions.push_back(std::move(one));
  }
  return {{"position", std::move(positions)}};
}

Json advice_json(const std::vector<Advice>& advice) {
  Json all = Json::array();
  for (const Advice& a : advice)
    all.push_back({{"text", advice_text(a)},
                   {"plan", plan_json(a.plan)},
                   {"separates", advised_labels(a)},
                   {"expected_sigma", a.expected_sigma},
                   {"now_sigma", a.now_sigma},
                   {"verified_sigma", a.verified_sigma}});
  return all;
}

/// What the recovered input says of each equation; the series itself is in residual_signal.csv.
Json equations_json(const Diagnosis& d) {
  Json all = Json::array();
  for (const RecoveredSignal& s : d.signals) {
    const std::string shape = shape_text(s, d.where.recordings);
    all.push_back(
        {{"equation", s.equation},
         {"unit", s.unit},
         {"shape", shape.empty() ? s.equation : fmt::format("{}: {}", s.equation, shape)},
         {"onset_s", s.shape.kind == Shape::Kind::onset ? s.shape.seconds : std::nan("")},
         {"period_s", s.shape.kind == Shape::Kind::period ? s.shape.seconds : std::nan("")},
         {"recording", s.shape.recording > 0 ? Json(s.shape.recording) : Json(nullptr)},
         {"covariate", text_or_null(s.shape.covariate)},
         {"correlation", s.shape.covariate.empty() ? std::nan("") : s.correlation}});
  }
  return all;
}

Json cosines_json(const CosineMatrix& cosines) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < cosines.cosine.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < cosines.cosine.cols(); ++j) row.push_back(cosines.cosine(i, j));
    rows.push_back(std::move(row));
  }
  return {{"labels", cosines.labels}, {"cosine", std::move(rows)}};
}

Json absent_json(const std::vector<std::string>& absent) {
  Json out = Json::array();
  if (identification::lacks(absent, accelerometer_channels)) out.push_back("accelerometers");
  if (identification::lacks(absent, gimbal_channels)) out.push_back("gimbals");
  return out;
}

}  // namespace

std::string to_json(const Diagnosis& d) {
  return dumped(diagnosis_document(d));
}

Json diagnosis_document(const Diagnosis& d) {
  Json out;
  out["schema"] = 1;
  out["verdict"] = std::string(text(d.verdict));
  out["p_value"] = d.p_value;
  out["sentence"] = sentence(d);
  out["latitude"] = latitude_json(d.site_doubt);
  out["at_that_latitude"] = d.there ? Json{{"verdict", std::string(text(d.there->verdict))},
                                           {"causes", causes_json(d.there->causes)}}
                                    : Json(nullptr);
  out["other_latitude"] = latitude_json(d.other_latitude);
  out["clock"] = clock_json(d.site_doubt ? d.site_doubt : d.other_latitude);
  const auto* times = remark_in<remark::TimesInstead>(d);
  out["or_times"] = times_json(times != nullptr ? std::optional(times->clock) : std::nullopt);
  if (times != nullptr) out["or_times"]["odds"] = times->odds;
  out["instants"] = instants_json(d);
  out["heading"] = d.heading_doubt ? heading_json(*d.heading_doubt) : Json(nullptr);
  out["field"] = field_json(d);
  out["absent"] = absent_json(d.absent);
  out["absent_positions"] = d.absent_positions;
  const auto* zero = remark_in<remark::GimbalOffZero>(d);
  const auto* left_out = remark_in<remark::SamplesLeftOut>(d);
  add_input(out, zero != nullptr ? zero->text : "",
            left_out != nullptr ? left_out->removed : std::vector<identification::Spike>{});
  const auto* loop = remark_in<remark::LoopLeftOut>(d);  // numbers of the recordings that state one
  out["loop_left_out"] = loop != nullptr ? Json(loop->loop.recordings) : Json::array();
  out["beyond_prior"] = beyond_prior_json(d);
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  out["prior_explains"] = beyond != nullptr && beyond->explains;
  out["other_equation_gain"] = d.other_equation_gain;
  out["where"] = where_json(d.where);
  out["causes"] = causes_json(d.causes);
  out["candidates"] =
      rows_json(candidate_table(d),
                "term score p_value absorbed axis label dof p_value_alone amplitude sigma "
                "smallest_detectable unit size_sigma log_bayes probability_alone adequate "
                "observable why_not");
  out["not_examined"] = not_examined_json(d);
  out["probabilities"] = probabilities_json(d.probabilities);
  out["proposal"] = d.proposal ? Json(d.proposal->text) : Json(nullptr);
  out["proposal_fit"] = form_json(d.proposal);
  out["fit"] = fit_json(d);
  out["profiles"] = profiles_json(d.profiles);
  out["advice"] = advice_json(d.advice);
  out["model"] = d.has_patch || declares_noise(d) ? Json("patched.toml") : Json(nullptr);
  out["noise"] = rows_json(noise_table(d));
  out["equations"] = equations_json(d);
  out["cosines"] = cosines_json(d.cosines);
  out["inseparable"] = twins_in_words(d.inseparable, instrument_of(d));
  out["remarks"] = remarks_of(d);
  Json& seconds = out["seconds"] = Json::object();
  for (const auto& [stage, time] : d.seconds) seconds[stage] = time;
  return out;
}

}  // namespace drift::report
