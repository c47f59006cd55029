#include <cmath>

#include "analysis/report/study/sections.hpp"
#include "analysis/report/svg/bar_chart.hpp"
#include "analysis/report/svg/figure.hpp"

namespace drift::report {
namespace {

using mc::FilterStatistics;

/// Mean of a chi-square over its degrees of freedom, coloured by its band.
Cell chi_square_cell(const mc::ChiSquareSum& sum) {
  if (!(sum.dof > 0.0)) return "-";
  const double mean = sum.mean();
  return {mean, mean < 1e4 ? fmt::format("{:.4g}", mean) : fmt::format("{:.1e}", mean),
          sum.holds()                           ? Tone::good
          : mean < evident_misfit && mean > 0.9 ? Tone::doubtful
                                                : Tone::bad};
}

std::string worst_text(const FilterStatistics& filter, double claims) {
  const std::size_t k = worst_parameter(filter, claims);
  if (k == filter.errors().size()) return "-";
  return fmt::format("{}: {}", key_at(filter, k),
                     number_text(filter.errors()[k].deception().value));
}

/// Where the estimates of the table start: the first start of every filter.
std::string start_text(const StudyResults& results) {
  bool listed = false;
  for (const mc::StudyPoint& point : results.points)
    for (const FilterSpec& f : point.study.filters)
      listed = listed || (!f.starts.empty() && !f.starts.front().empty());
  return listed ? "Filters started at the first of filter.starts, the prior mean where it says "
                  "nothing (start 1)"
                : "Filters started at the prior mean (start 1)";
}

/// Truth x filter: consistency, health, silent failures, the worst parameter. starts: where the
/// other starts stand.
Table crossed_table(const StudyResults& results, std::string_view starts) {
  Table table(
      "Truth against filter",
      "<truth | <filter | runs | NIS/dof | NEES/dof | cover 2s % | healthy % | wrong % | "
      "silent failures | worst: RMSE/sigma",
      fmt::format("{1}; other starts: {2}. NIS, NEES "
                  "per degree of freedom: 1 for an honest filter; NEES over the directions it "
                  "learned (sigma below {0} of the prior's). Healthy: NIS inside its 95 % band. "
                  "Wrong: some parameter whose sigma is below {0} of its prior is more than 5 "
                  "sigma off, or the filter diverged. Silent: wrong and healthy, 95 % interval "
                  "(Wilson). RMSE/sigma and coverage: of parameters with such sigmas.",
                  claims_of(results), start_text(results), starts));
  std::string condition = "-";
  for (const Pair& pair : pairs_of(results)) {
    const mc::StudyPoint& point = results.points[pair.point];
    const FilterStatistics& f = statistics_of(results, pair);
    const mc::StartStatistics& s = f.starts().front();
    if (condition_of(point) != condition) {
      condition = condition_of(point);
      if (!condition.empty()) table.add_heading(condition);
    }
    const Tone tone = s.silent.low() > 0.01    ? Tone::bad
                      : matched(results, pair) ? Tone::good
                                               : Tone::plain;
    table.add({key_of(point.study.truth.coupling), f.columns().name,
               results.statistics[pair.point].runs(), chi_square_cell(s.nis),
               chi_square_cell(s.nees), percent_cell(coverage_of_claims(f, claims_of(results))),
               percent_cell(s.healthy.value()), percent_cell(s.wrong.value()),
               rate_cell(s.silent, tone), worst_text(f, claims_of(results))});
  }
  return table;
}

/// Silent failure rate of every truth and filter, with intervals.
Figure silent_failure_figure(const StudyResults& results) {
  BarChart chart{"Silent failures",
                 "share of runs that are wrong and look healthy [%]",
                 {},
                 std::nullopt,
                 860.0};
  for (const Pair& pair : pairs_of(results)) {
    const stats::Rate& rate = statistics_of(results, pair).starts().front().silent;
    chart.bars.push_back({label_of(results, pair), 100.0 * rate.value(), 100.0 * rate.low(),
                          100.0 * rate.high(),
                          matched(results, pair) ? std::size_t{2} : std::size_t{1}, ""});
  }
  return figure_of(
      std::move(chart),
      "Silent failure rate with its 95 % interval, truth > filter: runs in which some "
      "parameter that the filter claims to know is more than 5 sigma off while its own "
      "statistics look healthy.");
}

/// Starts of every pair beside each other.
Table start_table(const StudyResults& results) {
  Table table("Starts",
              "<truth and filter | start | NIS/dof | white % | NEES/dof | NEES all | healthy % | "
              "wrong % | silent failures | diverged",
              "Drawn starts: the first is the prior mean, the others are drawn from the prior. A "
              "start that is a prior sigma off adds to NIS and NEES, most in directions that the "
              "test does not see: its error has twice the variance the filter believes.");
  for (const Pair& pair : pairs_of(results)) {
    const auto& starts = statistics_of(results, pair).starts();
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const mc::StartStatistics& s = starts[k];
      table.add({k == 0 ? pair_in_words(results, pair) : "", k + 1, chi_square_cell(s.nis),
                 percent_cell(s.white.value()), chi_square_cell(s.nees),
                 chi_square_cell(s.nees_all), percent_cell(s.healthy.value()),
                 percent_cell(s.wrong.value()), rate_cell(s.silent), s.diverged.hits});
    }
  }
  return table;
}

}  // namespace

Section crossed(const StudyResults& results) {
  return {"Truth against filter",
          {{crossed_table(results, "report"), On::terminal},
           {crossed_table(results, "see Starts below"), On::page},
           silent_failure_figure(results),
           {start_table(results), On::page}}};
}

}  // namespace drift::report
