#include <algorithm>
#include <cmath>

#include "analysis/report/rank/sections.hpp"

namespace drift::report {

/// Parameters of which eqs. (5) and (6) promise different sigmas.
Section equations(const RankedGroup& v) {
  constexpr double factor = 1.5;  // between the sigmas: worth a line
  const auto& models = v.group.models;
  if (models.size() < 2) return {};
  Table t("Where eqs. (5) and (6) promise different sigmas",
          "<parameter | prior | eq5 | eq6 | eq6/eq5");
  const bool swapped = models[0].model.spec.coupling == Coupling::eq6;
  const observability::Ranking& r5 = models[swapped ? 1 : 0].ranking;
  const observability::Ranking& r6 = models[swapped ? 0 : 1].ranking;
  const auto ratio = [&](std::size_t k) { return r6.learning_ratio(k) / r5.learning_ratio(k); };
  const auto apart = [&](std::size_t k) { return std::abs(std::log(ratio(k))); };
  std::vector<std::size_t> states = r5.order;
  std::ranges::stable_sort(states, std::greater{}, apart);
  for (const std::size_t k : states) {
    if (apart(k) < std::log(factor)) break;
    const observability::ParameterRank &p5 = r5.parameters[k], &p6 = r6.parameters[k];
    const double unit = unit_of(p5.param);
    t.add({parameter_cell(p5.param), p5.prior_sigma / unit, p5.posterior_sigma / unit,
           p6.posterior_sigma / unit, ratio(k)});
  }
  if (t.rows.empty())
    t.note = fmt::format(
        "No parameter's sigma differs by more than a factor {}: on this plan the two equations see "
        "equally much.",
        factor);
  return {"", {t}};
}

/// Parameters whose sigma depends on where the truth lies.
Section elsewhere(const RankedGroup& v) {
  Section section;
  for (const planning::ModelRanking& m : v.group.models) {
    if (std::ranges::none_of(m.elsewhere, &planning::Elsewhere::drawn)) continue;
    Table t(
        fmt::format("Where the promise depends on the truth, {}", key_of(m.model.spec.coupling)),
        "<parameter | left, as ranked | <left, at four drawn truths",
        "Parameters enter as products here: the sigma at the point of the ranking is not the "
        "one elsewhere.");
    for (const std::size_t k : m.ranking.order) {
      const double here = m.ranking.learning_ratio(k);
      const planning::Elsewhere& e = m.elsewhere[k];
      if (!e.other_than(here)) continue;
      t.add({parameter_cell(m.ranking.layout.params[k]), here, span_cell(e.low, e.high)});
    }
    if (t.rows.empty())
      t.note = fmt::format("No sigma changes by more than a factor {} at truths drawn from {}.",
                           planning::Elsewhere::factor, source_of_truths(v.study.has_truth));
    section.add({t});
  }
  return section;
}

}  // namespace drift::report
