#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/blind/key.hpp"
#include "analysis/report/blind/report.hpp"

namespace drift::report {
namespace {

using Json = nlohmann::ordered_json;

Json number(double v) {
  return std::isfinite(v) ? Json(v) : Json(nullptr);
}

Json of(const blind::Proportion& p) {
  return {{"share", number(p.share())},
          {"low", p.low},
          {"high", p.high},
          {"successes", p.k},
          {"trials", p.n}};
}

Json of(const std::vector<std::pair<std::string, blind::Proportion>>& list) {
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
    out.push_back({{"name", t.name},
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

Json of(const blind::TrialScore& t) {
  Json hidden = Json::array(), pulls = Json::array();
  for (const blind::HiddenEffect& e : t.key.effects) {
    hidden.push_back({{"term", e.term},
                      {"axis", e.axis},
                      {"size", number(e.size)},
                      {"absorbed", number(e.absorbed)}});
    if (!e.nearest.empty()) {
      hidden.back()["nearest"] = e.nearest;
      hidden.back()["nearest_cosine"] = number(e.nearest_cosine);
    }
  }
  for (const blind::Pull& p : t.pulls)
    pulls.push_back({{"key", p.key}, {"pull", number(p.pull())}});
  return {{"trial", t.key.plan.number},
          {"stratum", blind::name_in(blind::stratum_names, t.key.plan.stratum)},
          {"plan", t.key.plan.plan},
          {"mode", blind::name_in(blind::mode_names, t.key.plan.mode)},
          {"truth_coupling", blind::name_in(blind::coupling_names, t.key.plan.coupling)},
          {"hidden", hidden},
          {"concealed", t.key.certificate.concealed},
          {"largest_bias_sigma", number(t.key.certificate.largest_bias)},
          {"verdict", t.answer.failed ? "failed" : std::string(diagnosis::text(t.answer.verdict))},
          {"called", t.called},
          {"p_value", number(t.answer.p_value)},
          {"detected", t.detected},
          {"false_alarm", t.false_alarm},
          {"exact", t.exact},
          {"exact_or_twin", t.exact_or_twin},
          {"in_set", t.in_set},
          {"subsystem", t.subsystem},
          {"confidently_wrong", t.confidently_wrong},
          {"pulls", pulls},
          {"noise", t.answer.noise},
          {"held_out_gain", number(t.answer.held_out_gain)},
          {"seconds", number(t.answer.seconds)},
          {"failure", t.answer.failure}};
}

Json of(const blind::Confusion& c) {
  Json rows = Json::object();
  for (const blind::ConfusionRow& r : c.rows) rows[r.hidden] = r.called;
  return {{"columns", c.columns}, {"rows", rows}};
}

}  // namespace

std::string to_json(const blind::Summary& s, const std::vector<blind::TrialScore>& scores,
                    const Hashes& hashes) {
  Json trials = Json::array();
  for (const blind::TrialScore& t : scores) trials.push_back(of(t));
  const Json out{
      {"schema", 1},
      {"key_sha256", hashes.key},
      {"answers_sha256", hashes.answers},
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
      {"pull_rms", number(s.pull_rms)},
      {"largest_bias_median_sigma", number(s.largest_bias_median)},
      {"seconds", {{"mean", number(s.mean_seconds)}, {"longest", number(s.longest_seconds)}}},
      {"scores", trials}};
  return out.dump(1) + "\n";
}

}  // namespace drift::report
