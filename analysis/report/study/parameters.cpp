#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/report/study/sections.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/figure.hpp"

namespace drift::report {
namespace {

using mc::ErrorStatistics;
using mc::FilterStatistics;

/// Monte Carlo ranking of a pair: RMSE over prior sigma of every parameter with its
/// interval, best known first.
Figure ranking_figure(const StudyResults& results, const Pair& pair) {
  const FilterStatistics& filter = statistics_of(results, pair);
  std::vector<std::size_t> order(filter.errors().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) {
    const double v = filter.errors()[k].rmse().value / filter.errors()[k].prior_sigma();
    return std::isfinite(v) ? v : std::numeric_limits<double>::infinity();
  });
  BarChart chart{fmt::format("Monte Carlo ranking, {}", label_of(results, pair)),
                 "RMSE / prior sigma (logarithmic)",
                 {},
                 ReferenceLine{1.0, "nothing learned", Stroke::dashed},
                 860.0,
                 Spacing::logarithmic};
  for (const std::size_t k : order) {
    const ErrorStatistics& e = filter.errors()[k];
    const mc::Estimated rmse = e.rmse();
    const double prior = e.prior_sigma();
    chart.bars.push_back(
        {key_at(filter, k), rmse.value / prior, rmse.low / prior, rmse.high / prior, 0,
         fmt::format("{} (sigma {})", number_text(rmse.value / prior), number_text(e.learning()))});
  }
  return figure_of(
      std::move(chart),
      "Parameters by Monte Carlo RMSE over prior sigma with 95 % intervals; in "
      "brackets what the filter says, sigma over prior sigma. 1: nothing learned; an interval "
      "wholly above 1: misled.");
}

/// Every parameter of a pair: bias, RMSE, sigma, deception, coverage, silent failures, starts.
Table parameter_table(const StudyResults& results, const Pair& pair) {
  const FilterStatistics& f = statistics_of(results, pair);
  Table table(pair_in_words(results, pair),
              "<parameter | <unit | bias | RMSE | 95 % | sigma | RMSE/prior | sigma/prior | "
              "RMSE/sigma | in 1s % | 2s % | 3s % | start ratio | silent %",
              "RMSE with its 95 % interval. Bias ± 95 %. Sigma: root mean "
              "square of what the filter says. RMSE/sigma: the deception ratio, 1 for an honest "
              "filter. Start ratio: spread between starts over sigma, above 5 the answer depends "
              "on the start. An honest filter has 68.3, 95.4 and 99.7 % inside 1, 2 and 3 sigma.");
  for (std::size_t k = 0; k < f.errors().size(); ++k) {
    const ErrorStatistics& e = f.errors()[k];
    const std::size_t param = f.columns().layout.params[k];
    const double unit = unit_of(param), bias = e.bias().value / unit;
    const mc::Estimated rmse = e.rmse(), deception = e.deception();
    const Tone tone = deception.low > 2.0   ? Tone::bad
                      : deception.low > 1.1 ? Tone::doubtful
                                            : Tone::plain;
    table.add(
        {parameter_key(param), parameter_unit(param),
         Cell(bias, std::isfinite(bias) ? fmt::format("{}±{}", number_text(bias, 2),
                                                      number_text(e.bias().half_width() / unit, 2))
                                        : "-"),
         rmse.value / unit, span_cell(rmse.low / unit, rmse.high / unit), e.mean_sigma() / unit,
         rmse.value / e.prior_sigma(), e.learning(), digits(deception.value, 3, tone),
         percent_cell(e.coverage()[0].value()), percent_cell(e.coverage()[1].value()),
         percent_cell(e.coverage()[2].value()), digits(f.health()[k].start_ratio(), 2),
         percent_cell(f.health()[k].silent.value())});
  }
  return table;
}

}  // namespace

/// Of the pictured points the right filter; the first where none is right.
Section ranking(const StudyResults& results) {
  Section section{"Ranking by Monte Carlo", {}, On::page};
  if (const std::string rest = not_pictured_text(results); !rest.empty())
    section.add({Paragraph{rest}});
  for (const std::size_t p : pictured_points(results)) {
    Pair best{p, 0};
    for (std::size_t f = results.statistics[p].filters().size(); f-- > 0;)
      if (matched(results, {p, f})) best.filter = f;
    section.add({ranking_figure(results, best)});
  }
  return section;
}

Section parameters(const StudyResults& results) {
  constexpr std::size_t most = 24;  // pairs of which there is a table
  const std::vector<Pair> pairs = pairs_of(results);
  Section section{"Every parameter", {}, On::page};
  for (std::size_t k = 0; k < std::min(most, pairs.size()); ++k)
    section.add({parameter_table(results, pairs[k])});
  if (pairs.size() > most)
    section.add(
        {Paragraph{fmt::format("{} more tables are in summary.json.", pairs.size() - most)}});
  return section;
}

}  // namespace drift::report
