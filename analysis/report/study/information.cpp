#include <algorithm>
#include <set>

#include "analysis/observability/against_monte_carlo.hpp"
#include "analysis/planning/rank.hpp"
#include "analysis/report/rank/report.hpp"
#include "analysis/report/study/sections.hpp"
#include "analysis/report/svg/figure.hpp"
#include "core/base/check.hpp"
#include "core/physics/stochastic.hpp"
#include "mc/study/own_terms_on_plan.hpp"

namespace drift::report {
namespace {

/// The ranking of a filter's own model in a group of its plan.
const planning::ModelRanking* ranking_of(const planning::PlanRanking& plan,
                                         const FilterSpec& filter) {
  for (const planning::RankingGroup& group : plan.groups) {
    if (std::ranges::find(group.each, filter.name, &planning::RankingGroup::Named::name) ==
        group.each.end())
      continue;
    for (const planning::ModelRanking& m : group.models)
      if (m.model.spec.coupling == filter.coupling) return &m;
  }
  return nullptr;
}

/// Whether the process noise of the truth is other than what a filter allows for, whose walk stands
/// for jumps, too.
observability::ProcessNoiseIs noise_beside(const TruthSpec& truth, const FilterSpec& filter) {
  const Theta drawn = make_layout(truth).theta, known = make_layout(filter).theta;
  const TermMask has = truth.model().terms, allows = filter.model().terms;
  bool same = truth.noise.angle_random_walk == filter.noise.angle_random_walk &&
              !is_bistable(has) && !is_bistable(allows);
  for (int axis = 0; axis < 3; ++axis)
    same = same && drift_walk(truth.noise, has, drawn, axis) ==
                       drift_walk(filter.noise, allows, known, axis);
  return same ? observability::ProcessNoiseIs::nowhere : observability::ProcessNoiseIs::there;
}

std::vector<observability::MonteCarloError> errors_of(const mc::FilterStatistics& found) {
  std::vector<observability::MonteCarloError> errors;
  for (std::size_t k = 0; k < found.errors().size(); ++k) {
    const mc::Estimated rmse = found.errors()[k].rmse();
    errors.push_back({found.columns().layout.params[k], rmse.value, rmse.low, rmse.high,
                      found.errors()[k].mean_sigma()});
  }
  return errors;
}

Table comparison_table(const observability::MonteCarloComparison& comparison,
                       const std::string& title) {
  Table table(fmt::format("{}. Promised and found; rank correlation {}", title,
                          number_text(comparison.spearman, 2)),
              "<parameter | promised | found RMSE/prior | <95 % | rank | rank found | <verdict");
  for (const observability::ErrorComparison& c : comparison.parameters)
    table.add({parameter_key(c.param), c.learning_ratio, c.rmse_ratio, span_cell(c.low, c.high),
               c.rank_promised, c.rank_found, text_of(c.verdict)});
  return table;
}

/// Each reason once, with the parameters it is given for.
Sentences reasons(const observability::MonteCarloComparison& comparison) {
  Sentences sentences;
  std::vector<std::pair<std::string, std::string>> by_reason;
  for (const observability::ErrorComparison& c : comparison.parameters) {
    if (c.reason.empty()) continue;
    const std::string key = parameter_key(c.param);
    const auto known =
        std::ranges::find(by_reason, c.reason, &std::pair<std::string, std::string>::first);
    if (known == by_reason.end())
      by_reason.emplace_back(c.reason, key);
    else
      known->second += ", " + key;
  }
  for (const auto& [reason, keys] : by_reason)
    sentences.items.push_back(fmt::format("{}: {}", keys, reason));
  return sentences;
}

/// Why the plan of a point cannot be ranked, though its runs were tried. Own terms stand in its
/// file at other lines than in the study's.
std::string why_not_ranked(const mc::Study& point, const InputError& error) {
  const std::vector<mc::BrokenTerm> broken = mc::broken_own_terms(point);
  return broken.empty() ? error.what() : broken.front().what;
}

}  // namespace

Section information_section(const StudyResults& results, int threads) {
  Section section{"What the plan promises and what the runs found",
                  {Paragraph{"Promised: posterior over prior sigma by Fisher information along "
                             "the integrated test (learning ratio). Found: root mean square error "
                             "of the runs over the prior sigma, with its interval of 95 %."}},
                  On::page};
  std::set<std::string> shown;  // points that differ in the truth alone have one plan
  for (const std::size_t p : pictured_points(results)) {
    const mc::Study& study = results.points[p].study;
    planning::PlanRanking plan;
    try {
      plan = planning::rank_plan(study, {.threads = threads});
    } catch (const InputError& error) {
      section.add({Paragraph{fmt::format("Nothing is promised for {}: {}.", name_of(results, p),
                                         why_not_ranked(study, error))}});
      continue;
    }
    for (std::size_t f = 0; f < study.filters.size(); ++f) {
      const planning::ModelRanking* model = ranking_of(plan, study.filters[f]);
      if (model == nullptr) continue;
      const mc::LeftOut lacks = left_out(results, {p, f});
      const auto comparison = observability::compare_with_monte_carlo(
          model->ranking, errors_of(statistics_of(results, {p, f})),
          lacks.nothing() ? observability::TruthIs::the_model
                          : observability::TruthIs::another_model,
          noise_beside(study.truth, study.filters[f]));
      const std::string condition = condition_of(results.points[p]);
      section.add(
          {comparison_table(
               comparison, fmt::format("Truth {}, filter {} ({}){}{}", key_of(study.truth.coupling),
                                       study.filters[f].name, model_in_words(lacks),
                                       condition.empty() ? "" : ", ", condition)),
           reasons(comparison)});
    }
    for (const planning::RankingGroup& group : plan.groups) {
      Figure learning = figure_of(learning_chart(group),
                                  "Learning ratios of the plan " + condition_of(results.points[p]));
      if (!shown.insert(learning.svg).second) continue;
      section.add({std::move(learning), figure_of(spectrum_chart(group),
                                                  "Eigenvalues of the prior-scaled information")});
    }
  }
  return section;
}

}  // namespace drift::report
