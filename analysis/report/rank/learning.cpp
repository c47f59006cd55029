#include <algorithm>
#include <cmath>

#include "analysis/report/rank/sections.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/figure.hpp"

namespace drift::report {
namespace {

Cell ratio_cell(double left) {
  return digits(left, 3,
                left < 0.1   ? Tone::good
                : left > 0.9 ? Tone::bad
                : left > 0.5 ? Tone::doubtful
                             : Tone::plain);
}

/// Whether a parameter is known equally well under every equation: one bar says it.
bool same_for_all(const planning::RankingGroup& group, std::size_t k) {
  constexpr double alike = 0.02;
  const double first = group.models.front().ranking.learning_ratio(k);
  return std::ranges::all_of(group.models, [&](const planning::ModelRanking& m) {
    return std::abs(m.ranking.learning_ratio(k) - first) <= alike * first;
  });
}

}  // namespace

BarChart learning_chart(const planning::RankingGroup& group) {
  BarChart chart{fmt::format("What the test teaches, {}", group.filters),
                 "log2(prior sigma / sigma after the test) [bit]; beside the bar: what is left of "
                 "the prior sigma",
                 {},
                 ReferenceLine{1.0, "half the prior", Stroke::dashed},
                 860.0};
  const observability::Ranking& first = group.models.front().ranking;
  for (const std::size_t k : first.order) {
    const bool alike = same_for_all(group, k);
    for (std::size_t m = 0; m < (alike ? 1 : group.models.size()); ++m) {
      const observability::ParameterRank& p = group.models[m].ranking.parameters[k];
      const std::string coupling(
          alike && group.models.size() > 1 ? "both" : key_of(group.models[m].model.spec.coupling));
      chart.bars.push_back(
          {.label = m == 0 ? parameter_key(first.layout, k) + "  " + coupling : coupling,
           .value = p.bits(),
           .colour = alike && group.models.size() > 1 ? 6 : m,
           .text = number_text(p.learning_ratio())});
    }
  }
  return chart;
}

Table ranking_table(const planning::ModelRanking& m, const planning::ModelRanking* other) {
  const observability::Ranking& r = m.ranking;
  Table t(fmt::format("Ranking, {}", key_of(m.model.spec.coupling)),
          fmt::format("rank=# | key=<parameter | unit= | nominal= | prior_sigma=prior | "
                      "posterior_sigma={} | learning_ratio=left | "
                      "learning_ratio_at_drawn_truths= | conditional_sigma=alone | "
                      "collinearity=collin. | bits=bits | most_correlated_with= | correlation=",
                      key_of(m.model.spec.coupling)),
          "1 sigma after the test; left: of the prior sigma (the learning ratio, by which they are "
          "ranked); alone: if all other parameters were known; collin.: sigma over alone; bits: "
          "log2(1/left).");
  if (other) t.add_columns(fmt::format("{} | left", key_of(other->model.spec.coupling)));
  for (std::size_t i = 0; i < r.order.size(); ++i) {
    const std::size_t k = r.order[i];
    const observability::ParameterRank& p = r.parameters[k];
    const double unit = unit_of(p.param);
    std::vector<Cell> row{
        i + 1,
        parameter_cell(p.param),
        parameter_unit(p.param),
        m.model.nominal[p.param] / unit,
        p.prior_sigma / unit,
        p.posterior_sigma / unit,
        ratio_cell(p.learning_ratio()),
        only_value(m.elsewhere[k].drawn()
                       ? Value(std::vector{m.elsewhere[k].low, m.elsewhere[k].high})
                       : Value()),
        p.conditional_sigma / unit,
        p.collinearity(),
        decimals(p.bits(), 1),
        text_or_nothing(p.partner == k ? "" : parameter_key(r.layout, p.partner)),
        p.correlation};
    if (other) {
      const observability::ParameterRank& q = other->ranking.parameters[k];
      row.insert(row.end(), {q.posterior_sigma / unit, ratio_cell(q.learning_ratio())});
    }
    t.add(std::move(row));
  }
  return t;
}

Section learning(const RankedGroup& v) {
  const auto& models = v.group.models;
  Table table = ranking_table(models.front(), models.size() > 1 ? &models[1] : nullptr);
  table.title = fmt::format("Ranking for {}", v.group.filters);
  return {fmt::format("Filter {}", v.group.filters),
          {figure_of(
               learning_chart(v.group),
               "Longer is better known. Each bar is one equation; grey: both know it equally well.",
               fmt::format("learning{}.svg", v.suffix)),
           table}};
}

}  // namespace drift::report
