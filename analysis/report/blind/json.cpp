#include <nlohmann/json.hpp>

#include "analysis/blind/key.hpp"
#include "analysis/report/blind/sections.hpp"
#include "analysis/report/blind/target_words.hpp"

namespace drift::report {
namespace {

Json of(const stats::Proportion& p) {
  return {
      {"share", p.share()}, {"low", p.low}, {"high", p.high}, {"successes", p.k}, {"trials", p.n}};
}

Json of(const std::vector<std::pair<std::string, stats::Proportion>>& list) {
  Json out = Json::object();
  for (const auto& [name, p] : list) out[name] = of(p);
  return out;
}

Json of(const std::vector<blind::GroupScore>& groups) {
  Json out = Json::object();
  for (const blind::GroupScore& g : groups)
    out[g.name] = {{"false_alarms", of(g.false_alarms)},
                   {"detected", of(g.detected)},
                   {"exact", of(g.exact)},
                   {"in_set", of(g.in_set)},
                   {"subsystem", of(g.subsystem)},
                   {"confidently_wrong", of(g.wrong)}};
  return out;
}

Json targets_of(const blind::Summary& s) {
  Json out = Json::array();
  for (const blind::Target& t : s.targets)
    out.push_back({{"name", std::string(name_for_machines(t.goal))},
                   {"from", t.low},
                   {"to", t.high},
                   {"measured", of(t.measured)},
                   {"met", t.met()},
                   {"standing", std::string(blind::text(t.standing()))}});
  return out;
}

Json power_of(const blind::Summary& s) {
  Json out = Json::array();
  for (const blind::PowerPoint& p : s.power)
    out.push_back({{"size", p.mean},
                   {"detected", of(p.detected)},
                   {"theory", p.theory},
                   {"exact", of(p.exact)},
                   {"in_set", of(p.in_set)},
                   {"subsystem", of(p.subsystem)},
                   {"confidently_wrong", of(p.wrong)}});
  return out;
}

Json of(const std::vector<blind::ReliabilityBin>& bins) {
  Json out = Json::array();
  for (const blind::ReliabilityBin& b : bins)
    out.push_back({{"from", b.low}, {"to", b.high}, {"stated", b.stated}, {"right", of(b.right)}});
  return out;
}

Json of(const blind::TrialScore& t) {
  Json hidden = Json::array(), pulls = Json::array();
  for (const blind::HiddenEffect& e : t.key.effects) {
    hidden.push_back(
        {{"term", e.term}, {"axis", e.axis}, {"size", e.size}, {"absorbed", e.absorbed}});
    if (!e.nearest.empty()) {
      hidden.back()["nearest"] = e.nearest;
      hidden.back()["nearest_cosine"] = e.nearest_cosine;
    }
  }
  for (const blind::Pull& p : t.pulls) pulls.push_back({{"key", p.key}, {"pull", p.pull()}});
  return {{"trial", t.key.plan.number},
          {"stratum", key_of(t.key.plan.stratum)},
          {"plan", t.key.plan.plan},
          {"mode", key_of(t.key.plan.mode)},
          {"truth_coupling", key_of(t.key.plan.coupling)},
          {"hidden", hidden},
          {"concealed", t.key.certificate.concealed},
          {"largest_bias_sigma", t.key.certificate.largest_bias},
          {"verdict", t.answer.failed ? "failed" : std::string(diagnosis::text(t.answer.verdict))},
          {"called", t.called},
          {"p_value", t.answer.p_value},
          {"detected", t.detected},
          {"false_alarm", t.false_alarm},
          {"exact", t.exact},
          {"exact_or_twin", t.exact_or_twin},
          {"in_set", t.in_set},
          {"subsystem", t.subsystem},
          {"confidently_wrong", t.confidently_wrong},
          {"belief", std::string(name_in(blind::belief_kinds, t.answer.belief.kind))},
          {"belief_probability", t.answer.belief.probability},
          {"believed_right", t.believed_right},
          {"pulls", pulls},
          {"noise", t.answer.noise},
          {"held_out_gain", t.answer.held_out_gain},
          {"seconds", t.answer.seconds},
          {"failure", t.answer.failure}};
}

Json of(const blind::Confusion& c) {
  Json rows = Json::object();
  for (const blind::ConfusionRow& r : c.rows) rows[r.hidden] = r.called;
  return {{"columns", c.columns}, {"rows", rows}};
}

}  // namespace

Json blind_document(const BlindResults& results) {
  const blind::Summary& s = results.summary;
  Json trials = Json::array();
  for (const blind::TrialScore& t : results.scores) trials.push_back(of(t));
  return {{"schema", 1},
          {"key_sha256", results.key_hash},
          {"answers_sha256", results.answers_hash},
          {"trials", s.trials},
          {"failed", s.failed},
          {"targets", targets_of(s)},
          {"concealed", of(s.concealed)},
          {"power", power_of(s)},
          {"plans", of(s.plans)},
          {"modes", of(s.modes)},
          {"couplings", of(s.couplings)},
          {"further", of(s.further)},
          {"wrong_noise", of(s.wrong_noise)},
          {"outside", of(s.outside)},
          {"confusion", of(s.confusion)},
          {"reliability", of(s.reliability.bins)},
          {"calibration_error", s.reliability.error},
          {"calibration_error_by_chance", s.reliability.error_by_chance},
          {"pull_rms", s.pull_rms},
          {"largest_bias_median_sigma", s.largest_bias_median},
          {"seconds", {{"mean", s.mean_seconds}, {"longest", s.longest_seconds}}},
          {"scores", trials}};
}

}  // namespace drift::report
