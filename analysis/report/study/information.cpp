#include "analysis/report/study/information.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "analysis/observability/against_monte_carlo.hpp"
#include "analysis/planning/rank.hpp"
#include "analysis/report/rank/report.hpp"
#include "core/base/number_text.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

/// The ranking of a filter's own model in a group of its plan.
const planning::ModelRanking* ranking_of(const planning::PlanRanking& plan,
                                         const FilterSpec& filter) {
  const Layout layout = make_layout(filter);
  for (const planning::RankingGroup& group : plan.groups)
    for (const planning::ModelRanking& m : group.models)
      if (m.model.spec.coupling == filter.coupling && m.ranking.layout.params == layout.params)
        return &m;
  return nullptr;
}

Table comparison_table(const observability::MonteCarloComparison& comparison) {
  Table table;
  table.title =
      fmt::format("Promised and found; rank correlation {}", number_text(comparison.spearman, 2));
  table.columns = {
      {"parameter", Align::left}, {"promised", Align::right}, {"found RMSE/prior", Align::right},
      {"95 %", Align::left},      {"rank", Align::right},     {"rank found", Align::right},
      {"verdict", Align::left}};
  for (const observability::ErrorComparison& c : comparison.parameters)
    table.add({std::string(TermLibrary::specs[c.param].key.view()),
               number_text(c.learning_ratio, 3), number_text(c.rmse_ratio, 3),
               fmt::format("{} to {}", number_text(c.low, 3), number_text(c.high, 3)),
               number_text(c.rank_promised, 3), number_text(c.rank_found, 3),
               std::string(text_of(c.verdict))});
  return table;
}

/// Each reason once, with the parameters it is given for.
Sentences reasons(const observability::MonteCarloComparison& comparison) {
  Sentences sentences;
  std::vector<std::pair<std::string, std::string>> by_reason;
  for (const observability::ErrorComparison& c : comparison.parameters) {
    if (c.reason.empty()) continue;
    const std::string key(TermLibrary::specs[c.param].key.view());
    const auto known =
        std::ranges::find(by_reason, c.reason, &std::pair<std::string, std::string>::first);
    if (known == by_reason.end())
      by_reason.emplace_back(c.reason, key);
    else
      known->second += ", " + key;
  }
  for (const auto& [reason, keys] : by_reason) sentences.items.push_back(keys + ": " + reason);
  return sentences;
}

}  // namespace

std::vector<Section> information_sections(const StudyResults& results, int threads) {
  Section section{"What the plan promises and what the runs found", {}};
  section.blocks.emplace_back(
      Paragraph{"Promised: posterior over prior sigma by Fisher information along the integrated "
                "test (learning ratio). "
                "Found: root mean square error of the runs over the prior sigma, with its "
                "bootstrap interval."});
  planning::RankOptions options;
  options.threads = threads;
  std::set<std::string> shown;  // points that differ in the truth alone have one plan
  for (const std::size_t p : pictured_points(results)) {
    const mc::Study& study = results.points[p].study;
    const planning::PlanRanking plan = planning::rank_plan(study, options);
    for (std::size_t f = 0; f < study.filters.size(); ++f) {
      const planning::ModelRanking* model = ranking_of(plan, study.filters[f]);
      if (model == nullptr) continue;
      const mc::FilterStatistics& found = statistics_of(results, {p, f});
      std::vector<observability::MonteCarloError> errors;
      for (std::size_t k = 0; k < found.errors().size(); ++k) {
        const mc::Estimated rmse = found.errors()[k].rmse();
        errors.push_back({found.columns().layout.params[k], rmse.value, rmse.low, rmse.high,
                          found.errors()[k].mean_sigma()});
      }
      const observability::MonteCarloComparison comparison =
          observability::compare_with_monte_carlo(model->ranking, errors,
                                                  matched(results, {p, f})
                                                      ? observability::TruthIs::the_model
                                                      : observability::TruthIs::another_model);
      Table table = comparison_table(comparison);
      table.title =
          fmt::format("Truth {}, filter {}{}{}. {}", key_of(study.truth.coupling),
                      study.filters[f].name, condition_of(results.points[p]).empty() ? "" : ", ",
                      condition_of(results.points[p]), table.title);
      section.blocks.emplace_back(std::move(table));
      if (Sentences why = reasons(comparison); !why.items.empty())
        section.blocks.emplace_back(std::move(why));
    }
    for (const planning::RankingGroup& group : plan.groups) {
      std::string learning = learning_figure(group);
      if (!shown.insert(learning).second) continue;
      section.blocks.emplace_back(Picture{
          std::move(learning), "Learning ratios of the plan " + condition_of(results.points[p])});
      section.blocks.emplace_back(
          Picture{spectrum_figure(group), "Eigenvalues of the prior-scaled information"});
    }
  }
  return {std::move(section)};
}

}  // namespace drift::report
