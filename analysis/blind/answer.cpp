#include "analysis/blind/answer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/check.hpp"
#include "core/base/json_number.hpp"

namespace drift::blind {
namespace {

using Json = nlohmann::ordered_json;
using diagnosis::Verdict;

Json of(const AnswerCause& c) {
  Json params = Json::array();
  for (const auto& p : c.parameters)
    params.push_back({{"key", p.key},
                      {"value", json_number(p.value)},
                      {"sigma", json_number(p.sigma)},
                      {"unit", p.unit},
                      {"profiled", p.profiled}});
  Json confusable = Json::array();
  for (const auto& o : c.confusable_with)
    confusable.push_back({{"term", o.term}, {"axis", o.axis}, {"cosine", json_number(o.cosine)}});
  return {{"term", c.term},       {"axis", c.axis},
          {"set", c.set},         {"probability", json_number(c.probability)},
          {"parameters", params}, {"confusable_with", confusable}};
}

Json of(const Belief& b) {
  Json causes = Json::array();
  for (const diagnosis::NamedEffect& c : b.causes)
    causes.push_back({{"term", c.term}, {"axis", c.axis}});
  return {{"kind", std::string(name_in(belief_kinds, b.kind))},
          {"probability", json_number(b.probability)},
          {"causes", causes}};
}

Belief belief_in(const Json& answer) {
  Belief b;
  if (!answer.contains("belief")) return b;  // answers of earlier builds have none
  const Json& j = answer.at("belief");
  b.kind = value_in(belief_kinds, j.at("kind").get<std::string>()).value_or(Belief::Kind::none);
  b.probability = number_of(j.at("probability"));
  for (const Json& c : j.at("causes")) b.causes.push_back({c.at("term"), c.at("axis"), ""});
  return b;
}

AnswerCause cause_of(const Json& j) {
  AnswerCause c{j.at("term"),
                j.at("axis"),
                whole_of<int>(j.at("set")),
                number_of(j.at("probability")),
                {},
                {}};
  for (const Json& p : j.at("parameters")) {
    search::CauseParameter q;
    q.key = p.at("key");
    q.value = number_of(p.at("value"));
    q.sigma = number_of(p.at("sigma"));
    q.unit = p.at("unit");
    q.profiled = p.at("profiled");
    c.parameters.push_back(std::move(q));
  }
  for (const Json& o :
       j.value("confusable_with", Json::array()))  // answers of earlier builds have none
    c.confusable_with.push_back({o.at("term"), o.at("axis"), number_of(o.at("cosine"))});
  return c;
}

Json of(const Answer& a) {
  Json causes = Json::array();
  for (const AnswerCause& c : a.causes) causes.push_back(of(c));
  return {{"trial", a.number},
          {"failed", a.failed},
          {"failure", a.failure},
          {"verdict", std::string(diagnosis::text(a.verdict))},
          {"p_value", json_number(a.p_value)},
          {"causes", causes},
          {"equation", a.equation},
          {"position", a.position},
          {"start_s", json_number(a.start_s)},
          {"end_s", json_number(a.end_s)},
          {"noise", a.noise},
          {"chi2_per_dof_before", json_number(a.chi2_before)},
          {"chi2_per_dof_after", json_number(a.chi2_after)},
          {"held_out", a.held_out},
          {"held_out_gain", json_number(a.held_out_gain)},
          {"belief", of(a.belief)}};
}

Answer from(const Json& j) {
  Answer a;
  a.number = whole_of<std::size_t>(j.at("trial"));
  a.failed = j.at("failed");
  a.failure = j.at("failure");
  a.verdict = value_in(diagnosis::verdicts, j.at("verdict").get<std::string>())
                  .value_or(Verdict::unexplained);
  a.p_value = number_of(j.at("p_value"));
  for (const Json& c : j.at("causes")) a.causes.push_back(cause_of(c));
  a.equation = j.at("equation");
  a.position = whole_of<int>(j.at("position"));
  a.start_s = number_of(j.at("start_s"));
  a.end_s = number_of(j.at("end_s"));
  a.noise = j.at("noise").get<std::vector<std::string>>();
  a.chi2_before = number_of(j.at("chi2_per_dof_before"));
  a.chi2_after = number_of(j.at("chi2_per_dof_after"));
  a.held_out = j.at("held_out");
  a.held_out_gain = number_of(j.at("held_out_gain"));
  a.belief = belief_in(j);
  if (j.contains("seconds")) a.seconds = number_of(j.at("seconds"));  // of earlier builds
  return a;
}

template <class Read>
auto parsed(const std::string& json, const std::string& path, Read&& read) {
  try {
    return read(Json::parse(json));
  } catch (const std::exception& e) {
    throw InputError(
        ExitCode::self_check,
        fmt::format("{}: no answer can be read in it: {} (expected one as driftscope wrote it). "
                    "Move it away and run again: the trial is diagnosed anew",
                    path, e.what()));
  }
}

}  // namespace

std::vector<std::vector<const AnswerCause*>> Answer::alternatives() const {
  std::map<int, std::vector<const AnswerCause*>> sets;
  for (const AnswerCause& c : causes) sets[c.set].push_back(&c);
  std::vector<std::vector<const AnswerCause*>> all;
  for (auto& [which, members] : sets) all.push_back(std::move(members));
  return all;
}

Answer answer_of(const diagnosis::Diagnosis& d) {
  Answer a;
  a.verdict = d.verdict;
  a.p_value = d.p_value;
  for (const auto& c : d.causes)
    a.causes.push_back({c.term, c.axis, c.set, c.probability, c.parameters, c.confusable_with});
  a.equation = d.where.equation;
  if (!d.where.windows.empty()) {
    const auto& w = d.where.windows.front();
    a.position = w.position;
    a.start_s = w.start_s;
    a.end_s = w.end_s;
  }
  for (const auto& n : d.noise)
    if (n.significant) a.noise.push_back(n.component);
  a.chi2_before = d.fit.chi2_per_dof_before;
  a.chi2_after = d.fit.chi2_per_dof_after;
  a.held_out = !d.fit.held_out.folds.empty();
  a.held_out_gain = d.fit.held_out.log_score_gain;
  a.belief = belief_of(d.probabilities);
  return a;
}

std::string to_json(const Answer& answer) {
  return of(answer).dump(1) + "\n";
}

std::string to_json(const std::vector<Answer>& answers) {
  Json all = Json::array();
  for (const Answer& a : answers) all.push_back(of(a));
  return Json{{"schema", 1}, {"answers", all}}.dump(1) + "\n";
}

std::vector<Answer> answers_of(const std::string& json, const std::string& path) {
  return parsed(json, path, [](const Json& j) {
    std::vector<Answer> all;
    for (const Json& a : j.at("answers")) all.push_back(from(a));
    return all;
  });
}

Answer answer_of_json(const std::string& json, const std::string& path) {
  return parsed(json, path, [](const Json& j) { return from(j); });
}

}  // namespace drift::blind
