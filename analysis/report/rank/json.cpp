#include <nlohmann/json.hpp>

#include "analysis/report/rank/sections.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::report {
namespace {

Json numbers(const auto& values) {
  Json all = Json::array();
  for (const double v : values) all.push_back(v);
  return all;
}

Json spectrum_json(const observability::Ranking& r) {
  Json all = Json::array();
  for (const observability::EigenDirection& d : r.spectrum) {
    Json parts = Json::array();
    for (const std::size_t k : d.dominant)
      parts.push_back({{"key", parameter_key(r.layout, k)},
                       {"participation", d.participation(k)},
                       {"coefficient", d.direction[k]}});
    all.push_back({{"information", d.information}, {"dominant", parts}});
  }
  return all;
}

Json methods_json(const planning::ModelRanking& m) {
  Json all = Json::array();
  for (const observability::MethodRanking& method : m.methods) {
    Json scores = Json::object();
    for (std::size_t k = 0; k < m.ranking.layout.size(); ++k)
      scores[parameter_key(m.ranking.layout, k)] = method.score[k];
    Json off = Json::array();
    for (const auto& d : method.disagreements)
      off.push_back({{"key", parameter_key(m.ranking.layout, d.state)},
                     {"rank", d.rank_here},
                     {"rank_by_learning_ratio", d.rank_learning},
                     {"reason", d.reason}});
    all.push_back({{"key", method.key},
                   {"method", method.method},
                   {"spearman_with_learning_ratio", method.spearman},
                   {"scores", scores},
                   {"disagreements", off}});
  }
  return all;
}

/// By parameter, in the order of the layout: one number for each column.
Json by_parameter(const observability::Ranking& r, const MatX& values) {
  Json all = Json::object();
  for (std::size_t k = 0; k < r.layout.size(); ++k)
    all[parameter_key(r.layout, k)] =
        numbers(VecX(values.row(static_cast<Eigen::Index>(k)).transpose()));
  return all;
}

Json course_json(const mc::Study& study, const planning::ModelRanking& m) {
  Json bins = Json::array();
  for (const observability::TimeBin& b : m.bins)
    bins.push_back(
        {{"position", b.position + 1}, {"slew", b.slew}, {"start_s", b.t0}, {"end_s", b.t1}});
  return {{"positions", rows_json(position_table(study, m))},
          {"gain_bits", by_parameter(m.ranking, m.course.position_gain)},
          {"loss_bits_without", by_parameter(m.ranking, m.course.loss)},
          {"time_bins", bins},
          {"gain_bits_by_time_bin", by_parameter(m.ranking, m.course.gain)}};
}

Json model_json(const mc::Study& study, const planning::ModelRanking& m) {
  Json out;
  out["coupling"] = key_of(m.model.spec.coupling);
  out["of_the_file"] = m.of_the_file();
  out["terms"] = term_keys(m.model.spec.model().terms);
  out["bits"] = m.ranking.bits;
  out["of_last_sample"] = of_the_last_sample(m);
  out["parameters"] = rows_json(ranking_table(m, nullptr));
  out["spectrum"] = spectrum_json(m.ranking);
  out["null_directions"] = directions_json(unseen_directions(m));
  out["held_by_attitude_prior"] = directions_json(held_by_attitude(m));
  out["pwcs"] = {{"rank", m.pwcs.rank},
                 {"states", m.pwcs.states},
                 {"clear", m.pwcs.clear()},
                 {"singular_values", numbers(m.pwcs.singular_values)}};
  out["drivers"] = rows_json(driver_table(m));
  out["methods"] = methods_json(m);
  out["information"] = course_json(study, m);
  return out;
}

Json improvement_json(const mc::Study& study, const planning::PlanRanking& rank) {
  const planning::Improvement& better = rank.better->improvement;
  const observability::Ranking& before = rank.groups.front().models.front().ranking;
  Json sigmas = Json::object();
  for (std::size_t k = 0; k < before.layout.size(); ++k) {
    const std::size_t param = before.layout.params[k];
    const double unit = unit_of(param);
    const double prior = before.parameters[k].prior_sigma / unit;
    const planning::Elsewhere& elsewhere = rank.better->elsewhere[k];
    sigmas[parameter_key(param)] = {
        {"unit", parameter_unit(param)},
        {"before", before.parameters[k].posterior_sigma / unit},
        {"after", rank.better->after.parameters[k].posterior_sigma / unit},
        {"after_elsewhere", elsewhere.drawn()
                                ? Json::array({prior * elsewhere.low, prior * elsewhere.high})
                                : Json(nullptr)}};
  }
  return {{"criterion", better.criterion.text},
          {"coupling", equation_of_plan(rank)},
          {"hours_added", better.added() / 3600.0},
          {"bits_before", before.bits},
          {"bits_after", rank.better->after.bits},
          {"steps", rows_json(improvement_table(rank),
                              "name axes mode entry case_heading_deg hours candidates "
                              "criterion_before criterion_after")},
          {"sigma", sigmas},
          {"toml", better.steps.empty() ? std::string() : proposed_toml(study, rank)}};
}

}  // namespace

Json rank_document(const mc::Study& study, const planning::PlanRanking& rank) {
  Json out;
  out["schema"] = 1;
  out["study"] = {{"path", study.path}, {"title", study.title}};
  out["plan"] = {{"preset", text_or_null(study.plan.preset)},
                 {"positions", study.plan.positions.size()},
                 {"hours", rank.duration / 3600.0}};
  out["linearised_at"] = rank.at_truth ? "truth means" : "prior means";
  out["process_noise"] = rank.process_noise;
  out["assumed_field_gauss"] = rank.assumed_field_l
                                   ? numbers(Vec3(*rank.assumed_field_l / "gauss"_unit.to_si))
                                   : Json(nullptr);
  out["headlines"] = headlines(study, rank);
  Json& groups = out["filters"] = Json::array();
  for (const planning::RankingGroup& g : rank.groups) {
    Json models = Json::array();
    for (const planning::ModelRanking& m : g.models) models.push_back(model_json(study, m));
    groups.push_back({{"name", g.filters}, {"models", models}});
  }
  out["improvement"] = rank.better ? improvement_json(study, rank) : Json(nullptr);
  return out;
}

}  // namespace drift::report
