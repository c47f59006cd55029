#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/planning/candidates.hpp"
#include "analysis/report/rank/tables.hpp"
#include "core/base/number_text.hpp"

namespace drift::report {

Table improvement_table(const planning::PlanRanking& rank) {
  Table t;
  const planning::Improvement& better = rank.better->improvement;
  t.title = fmt::format("Positions to add, by criterion {}", better.criterion.text);
  t.columns = {{"#"},
               {"axes", Align::left},
               {"mode", Align::left},
               {"entry", Align::left},
               {"hours"},
               {"before"},
               {"after"},
               {"candidates"}};
  for (std::size_t i = 0; i < better.steps.size(); ++i) {
    const planning::ImprovementStep& s = better.steps[i];
    std::string entry = s.position.entry == Entry::caged ? "caged" : "torqued";
    if (s.position.case_heading)
      entry += fmt::format(", case at {:.0f} deg", *s.position.case_heading / detail::deg);
    t.add({std::to_string(i + 1), s.position.axes,
           s.position.mode == CommandLaw::free ? "free" : "level", entry,
           number_text(s.duration / 3600.0), number_text(s.before, 4), number_text(s.after, 4),
           std::to_string(s.feasible)});
  }
  const char* what = better.criterion.kind == planning::Criterion::Kind::A
                         ? "sum of squared learning ratios"
                     : better.criterion.kind == planning::Criterion::Kind::D
                         ? "log2 det of the prior-scaled posterior, over 2"
                         : "learning ratio of the parameter";
  t.note = fmt::format("Criterion: {}. Chosen one after the other for {}; {} h added.", what,
                       rank.groups.front().filters, number_text(better.added() / 3600.0, 4));
  if (better.steps.empty()) t.note += " The gimbals allow no candidate.";
  return t;
}

Table gain_table(const planning::PlanRanking& rank) {
  const observability::Ranking& before = rank.groups.front().models.front().ranking;
  const observability::Ranking& after = rank.better->after;
  Table t;
  t.title = "Expected sigma before and after";
  t.columns = {{"parameter", Align::left},
               {"prior"},
               {"before"},
               {"after"},
               {"left before"},
               {"left after"},
               {"gain"}};
  std::vector<std::size_t> states = before.order;
  const auto gain = [&](std::size_t k) {
    return before.learning_ratio(k) / after.learning_ratio(k);
  };
  std::ranges::stable_sort(states, std::greater{}, gain);
  for (const std::size_t k : states) {
    const observability::ParameterRank& p = before.parameters[k];
    const auto& spec = TermLibrary::specs[p.param];
    t.add({fmt::format("{} [{}]", spec.key.view(), spec.unit.symbol.view()),
           number_text(p.prior_sigma / spec.unit.to_si),
           number_text(p.posterior_sigma / spec.unit.to_si),
           number_text(after.parameters[k].posterior_sigma / spec.unit.to_si),
           number_text(before.learning_ratio(k)),
           number_text(after.learning_ratio(k)),
           {number_text(gain(k)), gain(k) > 2.0 ? Tone::good : Tone::plain}});
  }
  return t;
}

std::string proposed_toml(const mc::Study& study, const planning::PlanRanking& rank) {
  const TestPlan& plan = rank.better->improvement.plan;
  const bool preset = !study.plan.preset.empty();
  std::string text =
      preset ? fmt::format("# In [plan], instead of preset = \"{}\":\n", study.plan.preset)
             : "# After the last [[plan.position]]:\n";
  const std::size_t old = study.plan.positions.size();
  for (std::size_t p = preset ? 0 : old; p < plan.positions.size(); ++p)
    text += planning::position_toml(plan.positions[p]);
  return text;
}

}  // namespace drift::report
