#include <algorithm>
#include <cmath>

#include "analysis/planning/position_toml.hpp"
#include "analysis/report/rank/sections.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/figure.hpp"
#include "core/base/units.hpp"

namespace drift::report {
namespace {

std::string_view in_words(planning::Criterion::Kind kind) {
  switch (kind) {
    case planning::Criterion::Kind::A:
      return "sum of squared learning ratios";
    case planning::Criterion::Kind::D:
      return "log2 det of the prior-scaled posterior, over 2";
    default:
      return "learning ratio of the parameter";
  }
}

/// Before and after, largest gain first.
struct Gains {
  const observability::Ranking &before, &after;
  std::vector<std::size_t> states;
  double factor(std::size_t k) const { return before.learning_ratio(k) / after.learning_ratio(k); }
};

Gains gains_of(const planning::PlanRanking& rank) {
  const observability::Ranking& before = rank.groups.front().models.front().ranking;
  Gains gains{before, rank.better->after, before.order};
  std::ranges::stable_sort(gains.states, std::greater{},
                           [&](std::size_t k) { return gains.factor(k); });
  return gains;
}

/// Bits that the proposed positions add to the parameters that gain by them.
Figure gain_figure(const Gains& g) {
  constexpr std::size_t most = 24;
  constexpr double least = 0.01;  // [bit]
  BarChart chart{"What the proposed positions add",
                 "log2(sigma before / sigma after) [bit]; beside the bar: left of the prior sigma "
                 "before and after",
                 {},
                 std::nullopt,
                 860.0};
  for (const std::size_t k : g.states) {
    if (chart.bars.size() == most || !(std::log2(g.factor(k)) > least)) break;
    chart.bars.push_back({.label = parameter_key(g.before.layout, k),
                          .value = g.after.parameters[k].bits() - g.before.parameters[k].bits(),
                          .colour = 2,
                          .text = fmt::format("{} to {}", number_text(g.before.learning_ratio(k)),
                                              number_text(g.after.learning_ratio(k)))});
  }
  const std::size_t others = g.states.size() - chart.bars.size();
  return figure_of(
      std::move(chart),
      fmt::format("Expected gain from all proposed positions.{}",
                  others == 0 ? ""
                  : others == 1
                      ? " 1 parameter gains less, or nothing: it is in the table."
                      : fmt::format(" {} parameters gain less, or nothing: they are in the table.",
                                    others)),
      "improvement.svg");
}

Table gain_table(const Gains& g) {
  Table t("Expected sigma before and after",
          "<parameter | prior | before | after | left before | left after | gain");
  for (const std::size_t k : g.states) {
    const observability::ParameterRank& p = g.before.parameters[k];
    const double unit = unit_of(p.param);
    t.add({parameter_cell(p.param), p.prior_sigma / unit, p.posterior_sigma / unit,
           g.after.parameters[k].posterior_sigma / unit, g.before.learning_ratio(k),
           g.after.learning_ratio(k),
           digits(g.factor(k), 3, g.factor(k) > 2.0 ? Tone::good : Tone::plain)});
  }
  return t;
}

}  // namespace

std::string_view equation_of_plan(const planning::PlanRanking& rank) {
  return key_of(rank.groups.front().models.front().model.spec.coupling);
}

Table improvement_table(const planning::PlanRanking& rank) {
  const planning::Improvement& better = rank.better->improvement;
  Table t(fmt::format("Positions to add, by criterion {}", better.criterion.text),
          "# | name= | axes=<axes | mode=<mode | entry=<entry | case_heading_deg= | hours=hours | "
          "criterion_before=before | criterion_after=after | candidates=candidates",
          fmt::format("Criterion: {}. Chosen one after the other for a filter on {}; {} h added.{}",
                      in_words(better.criterion.kind), equation_of_plan(rank),
                      number_text(better.added() / unit::hour.to_si, 4),
                      better.steps.empty() ? " The gimbals allow no candidate." : ""));
  for (std::size_t i = 0; i < better.steps.size(); ++i) {
    const planning::ImprovementStep& s = better.steps[i];
    const std::string entry(key_of(s.position.entry));
    const auto& heading = s.position.case_heading;
    const double degrees = heading ? *heading / detail::deg : 0.0;
    t.add({i + 1, s.position.name, attitude_text(s.position), key_of(s.position.mode),
           Cell(entry, heading ? fmt::format("{}, case at {:.0f} deg", entry, degrees) : entry),
           only_value(heading ? Value(degrees) : Value()), s.duration / unit::hour.to_si,
           digits(s.before, 4), digits(s.after, 4), s.feasible});
  }
  return t;
}

std::string proposed_toml(const mc::Study& study, const planning::PlanRanking& rank) {
  const TestPlan& plan = rank.better->improvement.plan;
  const bool preset = !study.plan.preset.empty();
  const std::string head =
      preset ? fmt::format(
                   "# All of the plan, behind the other keys of [plan]. Remove preset = "
                   "\"{}\" there:\n",
                   study.plan.preset)
             : "# Behind the last [[plan.position]] and its keys:\n";
  const std::span positions(plan.positions);
  return head +
         planning::positions_toml(positions.subspan(preset ? 0 : study.plan.positions.size()));
}

Section improvement(const mc::Study& study, const planning::PlanRanking& rank) {
  if (!rank.better) return {};
  Section section{"A better plan", {improvement_table(rank)}};
  if (rank.better->improvement.steps.empty()) return section;
  const Gains gains = gains_of(rank);
  section.add({gain_figure(gains), gain_table(gains), Preformatted{proposed_toml(study, rank)}});
  return section;
}

}  // namespace drift::report
