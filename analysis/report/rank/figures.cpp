#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/report/rank/report.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/heat_map.hpp"
#include "analysis/report/svg/svg_chart.hpp"
#include "core/base/number_text.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

constexpr double least_shown = -12.0;  // log10 of the information that counts as none in a picture

std::string_view key_of_state(const Layout& layout, std::size_t state) {
  return TermLibrary::specs[layout.params[state]].key.view();
}

/// One row for each parameter, best known first.
HeatMap map_of(const observability::Ranking& r, const MatX& values) {
  HeatMap map;
  map.value.resize(values.rows(), values.cols());
  for (std::size_t i = 0; i < r.order.size(); ++i) {
    map.rows.emplace_back(key_of_state(r.layout, r.order[i]));
    map.value.row(static_cast<Eigen::Index>(i)) = values.row(static_cast<Eigen::Index>(r.order[i]));
  }
  map.value_label = "bit";
  map.row_height = 16.0;
  return map;
}

}  // namespace

std::string learning_figure(const planning::RankingGroup& group) {
  BarChart chart;
  chart.title = fmt::format("What the test teaches, {}", group.filters);
  chart.x_label =
      "log2(prior sigma / sigma after the test) [bit]; beside the bar: what is left of the prior "
      "sigma";
  chart.width = 860.0;
  const observability::Ranking& first = group.models.front().ranking;
  for (const std::size_t k : first.order)
    for (std::size_t m = 0; m < group.models.size(); ++m) {
      const observability::ParameterRank& p = group.models[m].ranking.parameters[k];
      const std::string coupling(key_of(group.models[m].model.spec.coupling));
      Bar bar;
      bar.label =
          m == 0 ? fmt::format("{}  {}", key_of_state(first.layout, k), coupling) : coupling;
      bar.value = p.bits();
      bar.colour = m;
      bar.text = number_text(p.learning_ratio());
      chart.bars.push_back(std::move(bar));
    }
  chart.limit = ReferenceLine{1.0, "half the prior", Stroke::dashed};
  return svg_of(chart);
}

std::string spectrum_figure(const planning::RankingGroup& group) {
  Chart chart;
  chart.title = fmt::format("Eigenvalues of the information, {}", group.filters);
  chart.panel_width = 720.0;
  chart.panel_height = 320.0;
  Panel panel;
  panel.x_label = "direction, best seen first; those not seen at all left out";
  panel.y_label = "log10(information / prior)";
  panel.references.push_back({0.0, "as good as the prior", Stroke::dashed});
  for (std::size_t m = 0; m < group.models.size(); ++m) {
    Series s{.label = std::string(key_of(group.models[m].model.spec.coupling)),
             .x = {},
             .y = {},
             .sigma = {},
             .colour = m};
    s.stroke = m == 0 ? Stroke::solid : Stroke::dashed;
    double index = 1.0;
    for (const observability::EigenDirection& d : group.models[m].ranking.spectrum) {
      const double x = index++, y = std::log10(std::max(d.information, 0.0));
      if (y < least_shown) continue;  // not seen at all
      s.x.push_back(x);
      s.y.push_back(y);
    }
    panel.series.push_back(std::move(s));
  }
  chart.panels.push_back(std::move(panel));
  return svg_of(chart);
}

std::string position_figure(const mc::Study& study, const planning::ModelRanking& m) {
  HeatMap map = map_of(m.ranking, m.course.position_gain);
  map.title = fmt::format("Which position informs which parameter, {} [bit]",
                          key_of(m.model.spec.coupling));
  for (std::size_t p = 0; p < study.plan.positions.size(); ++p)
    map.columns.push_back(fmt::format("{} {}", p + 1, study.plan.positions[p].name));
  return svg_of(map);
}

std::string time_figure(const planning::ModelRanking& m) {
  HeatMap map = map_of(m.ranking, m.course.gain);
  map.title =
      fmt::format("Which minutes inform which parameter, {} [bit]", key_of(m.model.spec.coupling));
  for (const observability::TimeBin& bin : m.bins)
    map.columns.push_back(
        fmt::format("{}: {:.0f} min{}", bin.position + 1, bin.t1 / 60.0, bin.slew ? ", slew" : ""));
  return svg_of(map);
}

std::string improvement_figure(const planning::PlanRanking& rank) {
  const observability::Ranking& before = rank.groups.front().models.front().ranking;
  const observability::Ranking& after = rank.better->after;
  BarChart chart;
  chart.title = "What the proposed positions add";
  chart.x_label =
      "log2(sigma before / sigma after) [bit]; beside the bar: left of the prior sigma before and "
      "after";
  chart.width = 860.0;
  std::vector<std::size_t> states = before.order;
  const auto gain = [&](std::size_t k) {
    return after.parameters[k].bits() - before.parameters[k].bits();
  };
  std::ranges::stable_sort(states, std::greater{}, gain);
  for (const std::size_t k : states) {
    Bar bar;
    bar.label = key_of_state(before.layout, k);
    bar.value = gain(k);
    bar.colour = 2;
    bar.text = fmt::format("{} to {}", number_text(before.learning_ratio(k)),
                           number_text(after.learning_ratio(k)));
    chart.bars.push_back(std::move(bar));
  }
  return svg_of(chart);
}

}  // namespace drift::report
