#include <algorithm>
#include <numeric>

#include "analysis/report/rank/sections.hpp"
#include "analysis/report/svg/figure.hpp"
#include "analysis/report/svg/heat_map.hpp"

namespace drift::report {
namespace {

constexpr double minute = 60.0;  // [s]

/// One row for each parameter, best known first.
HeatMap map_of(const planning::ModelRanking& m, std::string_view title, const MatX& values) {
  const observability::Ranking& r = m.ranking;
  HeatMap map;
  map.title = fmt::format("{}, {} [bit]", title, key_of(m.model.spec.coupling));
  map.value.resize(values.rows(), values.cols());
  for (std::size_t i = 0; i < r.order.size(); ++i) {
    map.rows.push_back(parameter_key(r.layout, r.order[i]));
    map.value.row(static_cast<Eigen::Index>(i)) = values.row(static_cast<Eigen::Index>(r.order[i]));
  }
  map.value_label = "bit";
  map.row_height = 16.0;
  return map;
}

/// Information by position and parameter.
HeatMap position_map(const mc::Study& study, const planning::ModelRanking& m) {
  HeatMap map = map_of(m, "Which position informs which parameter", m.course.position_gain);
  for (std::size_t p = 0; p < study.plan.positions.size(); ++p)
    map.columns.push_back(fmt::format("{} {}", p + 1, study.plan.positions[p].name));
  return map;
}

/// Information by time and parameter.
HeatMap time_map(const planning::ModelRanking& m) {
  HeatMap map = map_of(m, "Which minutes inform which parameter", m.course.gain);
  for (const observability::TimeBin& bin : m.bins)
    map.columns.push_back(fmt::format("{}: {:.0f} min{}", bin.position + 1, bin.t1 / minute,
                                      bin.slew ? ", slew" : ""));
  return map;
}

/// "D_I_z 9.1, eta_x 3.2" of the three largest; those below a tenth of a bit are left out.
std::string largest(const Layout& layout, const VecX& bits) {
  std::vector<std::size_t> states(layout.size());
  std::iota(states.begin(), states.end(), std::size_t{0});
  std::ranges::stable_sort(states, std::greater{}, [&](std::size_t k) { return bits[k]; });
  std::vector<std::string> parts;
  for (const std::size_t k : states)
    if (parts.size() < 3 && bits[k] >= 0.1)
      parts.push_back(fmt::format("{} {}", parameter_key(layout, k), decimal_text(bits[k], 1)));
  return parts.empty() ? "-" : fmt::format("{}", fmt::join(parts, ", "));
}

/// For each parameter the position and the minutes that tell most of it.
Table minutes_table(const mc::Study& study, const planning::ModelRanking& m) {
  Table t(
      fmt::format("Which minutes tell most of each parameter, {}", key_of(m.model.spec.coupling)),
      "<parameter | bits | <position | <minutes | bits there | <cannot do without",
      "Minutes from the start of the test.");
  for (const std::size_t k : m.ranking.order) {
    Eigen::Index bin = 0, position = 0;
    const double there = m.course.gain.row(k).maxCoeff(&bin);
    const double loss = m.course.loss.row(k).maxCoeff(&position);
    const observability::TimeBin& b = m.bins[bin];
    std::vector<Cell> row{parameter_key(m.ranking.layout, k),
                          decimals(m.ranking.parameters[k].bits(), 1)};
    if (there > 0.01)
      row.insert(row.end(), {study.plan.positions[b.position].name,
                             fmt::format("{} to {}{}", number_text(b.t0 / minute, 4),
                                         number_text(b.t1 / minute, 4), b.slew ? " (slew)" : ""),
                             decimals(there, 1)});
    else
      row.insert(row.end(), 3, "-");
    row.emplace_back(loss > 0.1 ? fmt::format("{} ({} bit)", study.plan.positions[position].name,
                                              decimal_text(loss, 1))
                                : "-");
    t.add(std::move(row));
  }
  return t;
}

}  // namespace

Table position_table(const mc::Study& study, const planning::ModelRanking& m) {
  Table t(fmt::format("What each position tells, {}", key_of(m.model.spec.coupling)),
          "position=# | name=<position | bits=bits | <tells most of [bit] | <lost without it [bit]",
          "Bits are log2 of sigma before over after, positions taken in their order; lost: of "
          "sigma without what was measured there over sigma.");
  for (std::size_t p = 0; p < study.plan.positions.size(); ++p)
    t.add({p + 1, study.plan.positions[p].name, decimals(m.course.bits[p], 1),
           largest(m.ranking.layout, m.course.position_gain.col(p)),
           largest(m.ranking.layout, m.course.loss.col(p))});
  return t;
}

Section course(const RankedGroup& v) {
  Section section;
  for (std::size_t k = 0; k < v.group.models.size(); ++k) {
    const planning::ModelRanking& m = v.group.models[k];
    section.add(
        {figure_of(
             position_map(v.study, m),
             "Bits of each parameter that each position adds, positions taken in their order.",
             k == 0 ? fmt::format("positions{}.svg", v.suffix) : ""),
         {position_table(v.study, m), shown_of(k)},
         figure_of(time_map(m),
                   "The same by time; columns are named by position and the minute they end at."),
         {minutes_table(v.study, m), On::page}});
  }
  return section;
}

}  // namespace drift::report
