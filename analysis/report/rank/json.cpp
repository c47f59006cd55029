#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/report/rank/report.hpp"
#include "analysis/report/rank/tables.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string text(std::string_view view) {
  return std::string(view);
}

std::string key_of_state(const observability::Ranking& r, std::size_t state) {
  return text(TermLibrary::specs[r.layout.params[state]].key.view());
}

Json numbers(const auto& values) {
  Json all = Json::array();
  for (const double v : values) all.push_back(number(v));
  return all;
}

Json parameters_json(const planning::ModelRanking& m) {
  const observability::Ranking& r = m.ranking;
  const observability::RankedModel& model = m.model;
  Json all = Json::array();
  for (std::size_t i = 0; i < r.order.size(); ++i) {
    const observability::ParameterRank& p = r.parameters[r.order[i]];
    const auto& spec = TermLibrary::specs[p.param];
    const double unit = spec.unit.to_si;
    all.push_back({{"rank", i + 1},
                   {"key", text(spec.key.view())},
                   {"unit", text(spec.unit.symbol.view())},
                   {"nominal", number(model.nominal[p.param] / unit)},
                   {"prior_sigma", number(p.prior_sigma / unit)},
                   {"posterior_sigma", number(p.posterior_sigma / unit)},
                   {"learning_ratio", number(p.learning_ratio())},
                   {"learning_ratio_at_drawn_truths",
                    {number(m.elsewhere[r.order[i]].low), number(m.elsewhere[r.order[i]].high)}},
                   {"conditional_sigma", number(p.conditional_sigma / unit)},
                   {"collinearity", number(p.collinearity())},
                   {"bits", number(p.bits())},
                   {"most_correlated_with",
                    p.partner == r.order[i] ? Json(nullptr) : Json(key_of_state(r, p.partner))},
                   {"correlation", number(p.correlation)}});
  }
  return all;
}

Json spectrum_json(const observability::Ranking& r) {
  Json all = Json::array();
  for (const observability::EigenDirection& d : r.spectrum) {
    Json parts = Json::array();
    for (const std::size_t k : d.dominant)
      parts.push_back({{"key", key_of_state(r, k)},
                       {"participation", number(d.participation(k))},
                       {"coefficient", number(d.direction[k])}});
    all.push_back({{"information", number(d.information)}, {"dominant", parts}});
  }
  return all;
}

Json directions_json(const std::vector<NamedDirection>& directions) {
  Json all = Json::array();
  for (const NamedDirection& d : directions) {
    Json parts = Json::object();
    for (const auto& part : d.parts)
      parts[text(TermLibrary::specs[part.param].key.view())] = number(part.coefficient);
    all.push_back({{"combination", d.combination},
                   {"coefficients", parts},
                   {"reason", d.reason.empty() ? Json(nullptr) : Json(d.reason)}});
  }
  return all;
}

Json methods_json(const planning::ModelRanking& m) {
  Json all = Json::array();
  for (const observability::MethodRanking& method : m.methods) {
    Json scores = Json::object();
    for (std::size_t k = 0; k < m.ranking.layout.size(); ++k)
      scores[key_of_state(m.ranking, k)] = number(method.score[k]);
    Json off = Json::array();
    for (const auto& d : method.disagreements)
      off.push_back({{"key", key_of_state(m.ranking, d.state)},
                     {"rank", number(d.rank_here)},
                     {"rank_by_learning_ratio", number(d.rank_learning)},
                     {"reason", d.reason}});
    all.push_back({{"key", method.key},
                   {"method", method.method},
                   {"spearman_with_learning_ratio", number(method.spearman)},
                   {"scores", scores},
                   {"disagreements", off}});
  }
  return all;
}

/// By parameter, in the order of the layout: one number for each column.
Json by_parameter(const observability::Ranking& r, const MatX& values) {
  Json all = Json::object();
  for (std::size_t k = 0; k < r.layout.size(); ++k)
    all[key_of_state(r, k)] = numbers(VecX(values.row(static_cast<Eigen::Index>(k)).transpose()));
  return all;
}

Json course_json(const mc::Study& study, const planning::ModelRanking& m) {
  Json positions = Json::array(), bins = Json::array();
  for (std::size_t p = 0; p < study.plan.positions.size(); ++p)
    positions.push_back({{"position", p + 1},
                         {"name", study.plan.positions[p].name},
                         {"bits", number(m.course.bits[p])}});
  for (const observability::TimeBin& b : m.bins)
    bins.push_back({{"position", b.position + 1},
                    {"slew", b.slew},
                    {"start_s", number(b.t0)},
                    {"end_s", number(b.t1)}});
  return {{"positions", positions},
          {"gain_bits", by_parameter(m.ranking, m.course.position_gain)},
          {"loss_bits_without", by_parameter(m.ranking, m.course.loss)},
          {"time_bins", bins},
          {"gain_bits_by_time_bin", by_parameter(m.ranking, m.course.gain)}};
}

Json model_json(const mc::Study& study, const planning::ModelRanking& m) {
  Json out;
  out["coupling"] = text(key_of(m.model.spec.coupling));
  out["of_the_file"] = m.of_the_file;
  out["terms"] = term_keys(m.model.spec.model().terms);
  out["bits"] = number(m.ranking.bits);
  out["parameters"] = parameters_json(m);
  out["spectrum"] = spectrum_json(m.ranking);
  out["null_directions"] = directions_json(exact_degeneracies(m));
  out["held_by_attitude_prior"] = directions_json(held_by_attitude(m));
  out["pwcs"] = {{"rank", m.pwcs.rank},
                 {"states", m.pwcs.states},
                 {"clear", m.pwcs.clear()},
                 {"singular_values", numbers(m.pwcs.singular_values)}};
  out["methods"] = methods_json(m);
  out["information"] = course_json(study, m);
  return out;
}

Json improvement_json(const mc::Study& study, const planning::PlanRanking& rank) {
  const planning::Improvement& better = rank.better->improvement;
  const observability::Ranking& before = rank.groups.front().models.front().ranking;
  Json steps = Json::array(), sigmas = Json::object();
  for (const planning::ImprovementStep& s : better.steps)
    steps.push_back(
        {{"name", s.position.name},
         {"axes", s.position.axes},
         {"mode", s.position.mode == CommandLaw::free ? "free" : "level"},
         {"entry", s.position.entry == Entry::caged ? "caged" : "torqued"},
         {"case_heading_deg",
          s.position.case_heading ? number(*s.position.case_heading / detail::deg) : Json(nullptr)},
         {"hours", number(s.duration / 3600.0)},
         {"candidates", s.feasible},
         {"criterion_before", number(s.before)},
         {"criterion_after", number(s.after)}});
  for (std::size_t k = 0; k < before.layout.size(); ++k) {
    const auto& spec = TermLibrary::specs[before.layout.params[k]];
    const double unit = spec.unit.to_si;
    sigmas[text(spec.key.view())] = {
        {"unit", text(spec.unit.symbol.view())},
        {"before", number(before.parameters[k].posterior_sigma / unit)},
        {"after", number(rank.better->after.parameters[k].posterior_sigma / unit)}};
  }
  return {{"criterion", better.criterion.text},
          {"hours_added", number(better.added() / 3600.0)},
          {"bits_before", number(before.bits)},
          {"bits_after", number(rank.better->after.bits)},
          {"steps", steps},
          {"sigma", sigmas},
          {"toml", better.steps.empty() ? std::string() : proposed_toml(study, rank)}};
}

}  // namespace

std::string to_json(const mc::Study& study, const planning::PlanRanking& rank) {
  Json out;
  out["schema"] = 1;
  out["study"] = {{"path", study.path}, {"title", study.title}};
  out["plan"] = {{"preset", study.plan.preset.empty() ? Json(nullptr) : Json(study.plan.preset)},
                 {"positions", study.plan.positions.size()},
                 {"hours", number(rank.duration / 3600.0)}};
  out["linearised_at"] = rank.at_truth ? "truth means" : "prior means";
  out["process_noise_left_out"] = rank.process_noise;
  out["headlines"] = headlines(study, rank);
  Json& groups = out["filters"] = Json::array();
  for (const planning::RankingGroup& g : rank.groups) {
    Json models = Json::array();
    for (const planning::ModelRanking& m : g.models) models.push_back(model_json(study, m));
    groups.push_back({{"name", g.filters}, {"models", models}});
  }
  out["improvement"] = rank.better ? improvement_json(study, rank) : Json(nullptr);
  // Names are free text; bytes that are not UTF-8 become U+FFFD instead of an exception.
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace drift::report
