#include "analysis/report/study/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/number_text.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

using mc::ErrorStatistics;
using mc::FilterStatistics;

double claims_of(const StudyResults& results) {
  return results.study.monte_carlo.healthy_sigma;
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f}", 100.0 * share) : "-";
}

/// Mean of a chi-square over its degrees of freedom, coloured by its band.
Cell chi_square_cell(const mc::ChiSquareSum& sum) {
  if (!(sum.dof > 0.0)) return {"-"};
  const std::string text =
      sum.mean() < 1e4 ? fmt::format("{:.4g}", sum.mean()) : fmt::format("{:.1e}", sum.mean());
  return {text, sum.holds()                            ? Tone::good
                : sum.mean() < 1.1 && sum.mean() > 0.9 ? Tone::doubtful
                                                       : Tone::bad};
}

std::string worst_text(const FilterStatistics& filter, double claims) {
  const std::size_t k = worst_parameter(filter, claims);
  if (k == filter.errors().size()) return "-";
  return fmt::format("{}: {}", key_at(filter, k),
                     number_text(filter.errors()[k].deception().value));
}

double coverage_of_claims(const FilterStatistics& filter, double claims) {
  double sum = 0.0;
  int n = 0;
  for (const ErrorStatistics& e : filter.errors())
    if (e.learning() < claims) {
      sum += e.coverage()[1].value();
      ++n;
    }
  return n > 0 ? sum / n : std::nan("");
}

std::string where(const StudyResults& results, const Pair& pair) {
  const std::string condition = condition_of(results.points[pair.point]);
  return fmt::format("{}truth {}, filter {}", condition.empty() ? "" : condition + ": ",
                     key_of(results.points[pair.point].study.truth.coupling),
                     statistics_of(results, pair).columns().name);
}

std::string headline_of(const StudyResults& results, const Pair& pair) {
  const FilterStatistics& filter = statistics_of(results, pair);
  const mc::StartStatistics& s = filter.starts().front();
  const std::string start = where(results, pair);
  if (matched(results, pair))
    return fmt::format(
        "{} (the right equation): 2 sigma hold {} % of the errors (95.4 expected) of what the "
        "filter claims to know; silent failures {}.",
        start, percent(coverage_of_claims(filter, claims_of(results))), percent_text(s.silent));
  std::string text = fmt::format(
      "{} (the wrong equation): in {} of the runs some parameter is more than 5 sigma "
      "off; silent failures, where nothing in the run shows it: {}",
      start, percent_text(s.wrong), percent_text(s.silent));
  const std::size_t k = worst_parameter(filter, claims_of(results));
  if (k < filter.errors().size())
    text += fmt::format("; worst {}: its error is {} times its sigma", key_at(filter, k),
                        number_text(filter.errors()[k].deception().value));
  // What no single parameter shows: combinations that the filter claims to know.
  if (const double nees = s.nees.mean(); nees > 4.0)
    text += fmt::format(
        "; combinations of parameters are off by {} times their sigma (root of NEES/dof)",
        number_text(std::sqrt(nees), 2));
  return text + ".";
}

}  // namespace

std::vector<std::string> study_headlines(const StudyResults& results) {
  constexpr std::size_t most = 12;
  std::vector<std::string> lines;
  std::vector<Pair> pairs = pairs_of(results);
  // The wrong pairs first, by falling silent failure rate.
  std::ranges::stable_sort(pairs, [&](const Pair& a, const Pair& b) {
    const auto key = [&](const Pair& p) {
      return std::pair(matched(results, p),
                       -statistics_of(results, p).starts().front().silent.value());
    };
    return key(a) < key(b);
  });
  std::vector<std::size_t> refused;
  for (const Pair& pair : pairs) {
    const auto& failures = results.statistics[pair.point].failures();
    if (failures.too_many()) {
      if (std::ranges::find(refused, pair.point) != refused.end()) continue;
      refused.push_back(pair.point);
      lines.push_back(
          fmt::format("No headline for {}: {} of the runs were lost, and what is left may be a "
                      "biased choice. See Failures.",
                      results.points[pair.point].label.empty() ? "this study"
                                                               : results.points[pair.point].label,
                      percent_text(failures.lost())));
    } else if (lines.size() < most) {
      lines.push_back(headline_of(results, pair));
    }
  }
  return lines;
}

Table crossed_table(const StudyResults& results) {
  Table table;
  table.title = "Truth against filter";
  table.columns = {{"truth", Align::left}, {"filter", Align::left}, {"runs"},      {"NIS/dof"},
                   {"NEES/dof"},           {"cover 2s %"},          {"healthy %"}, {"wrong %"},
                   {"silent failures"},    {"worst: RMSE/sigma"}};
  std::string condition = "-";
  for (const Pair& pair : pairs_of(results)) {
    const mc::StudyPoint& point = results.points[pair.point];
    const FilterStatistics& f = statistics_of(results, pair);
    const mc::StartStatistics& s = f.starts().front();
    if (condition_of(point) != condition) {
      condition = condition_of(point);
      if (!condition.empty()) table.add_heading(condition);
    }
    const bool right = matched(results, pair);
    table.add({std::string(key_of(point.study.truth.coupling)),
               f.columns().name,
               fmt::format("{}", results.statistics[pair.point].runs()),
               chi_square_cell(s.nis),
               chi_square_cell(s.nees),
               percent(coverage_of_claims(f, claims_of(results))),
               percent(s.healthy.value()),
               percent(s.wrong.value()),
               {percent_text(s.silent), s.silent.low() > 0.01 ? Tone::bad
                                        : right               ? Tone::good
                                                              : Tone::plain},
               worst_text(f, claims_of(results))});
  }
  table.note = fmt::format(
      "Filters started at the prior mean (start 1); other starts: report. NIS, NEES per degree of "
      "freedom: 1 for an honest filter; NEES over the directions it learned "
      "(sigma below {} of the prior's). Healthy: NIS inside its 95 % band. Wrong: some parameter "
      "whose sigma is "
      "below {} of its prior is more than 5 sigma off, or the filter diverged. Silent: wrong and "
      "healthy, 95 % interval (Wilson). "
      "RMSE/sigma and coverage: of parameters with such sigmas.",
      claims_of(results), claims_of(results));
  return table;
}

Table parameter_table(const StudyResults& results, const Pair& pair) {
  const FilterStatistics& f = statistics_of(results, pair);
  Table table;
  table.title = where(results, pair);
  table.columns = {{"parameter", Align::left},
                   {"unit", Align::left},
                   {"bias"},
                   {"RMSE"},
                   {"95 %"},
                   {"sigma"},
                   {"RMSE/prior"},
                   {"sigma/prior"},
                   {"RMSE/sigma"},
                   {"in 1s %"},
                   {"2s %"},
                   {"3s %"},
                   {"start ratio"},
                   {"silent %"}};
  for (std::size_t k = 0; k < f.errors().size(); ++k) {
    const ErrorStatistics& e = f.errors()[k];
    const mc::ParameterHealth& h = f.health()[k];
    const auto& spec = TermLibrary::specs[f.columns().layout.params[k]];
    const double unit = spec.unit.to_si;
    const mc::Estimated rmse = e.rmse(), bias = e.bias(), deception = e.deception();
    const Tone tone = deception.low > 2.0   ? Tone::bad
                      : deception.low > 1.1 ? Tone::doubtful
                                            : Tone::plain;
    table.add({std::string(spec.key.view()),
               std::string(spec.unit.symbol.view()),
               fmt::format("{}±{}", number_text(bias.value / unit, 2),
                           number_text(bias.half_width() / unit, 2)),
               number_text(rmse.value / unit),
               fmt::format("{} to {}", number_text(rmse.low / unit), number_text(rmse.high / unit)),
               number_text(e.mean_sigma() / unit),
               number_text(rmse.value / e.prior_sigma()),
               number_text(e.learning()),
               {number_text(deception.value), tone},
               percent(e.coverage()[0].value()),
               percent(e.coverage()[1].value()),
               percent(e.coverage()[2].value()),
               number_text(h.start_ratio(), 2),
               percent(h.silent.value())});
  }
  table.note =
      "RMSE with the 95 % interval of a bootstrap over runs. Bias ± 95 %. Sigma: root mean square "
      "of what "
      "the filter says. RMSE/sigma: the deception ratio, 1 for an honest filter. Start ratio: "
      "spread "
      "between starts over sigma, above 5 the answer depends on the start. An honest filter has "
      "68.3, "
      "95.4 and 99.7 % inside 1, 2 and 3 sigma.";
  return table;
}

Table start_table(const StudyResults& results) {
  Table table;
  table.title = "Starts";
  table.columns = {{"truth and filter", Align::left},
                   {"start"},
                   {"NIS/dof"},
                   {"white %"},
                   {"NEES/dof"},
                   {"NEES all"},
                   {"healthy %"},
                   {"wrong %"},
                   {"silent failures"},
                   {"diverged"}};
  for (const Pair& pair : pairs_of(results)) {
    const auto& starts = statistics_of(results, pair).starts();
    for (std::size_t k = 0; k < starts.size(); ++k) {
      const mc::StartStatistics& s = starts[k];
      table.add({k == 0 ? where(results, pair) : "", fmt::format("{}", k + 1),
                 chi_square_cell(s.nis), percent(s.white.value()), chi_square_cell(s.nees),
                 chi_square_cell(s.nees_all), percent(s.healthy.value()), percent(s.wrong.value()),
                 percent_text(s.silent), fmt::format("{}", s.diverged.hits)});
    }
  }
  table.note =
      "Drawn starts: the first is the prior mean, the others are drawn from the prior. A start "
      "that is a "
      "prior sigma off adds to NIS and NEES, most in directions that the test does not see: its "
      "error has "
      "twice the variance the filter believes.";
  return table;
}

Table failure_table(const StudyResults& results) {
  Table table;
  table.title = "Failures";
  table.columns = {{"study point", Align::left},
                   {"runs"},
                   {"lost"},
                   {"filter diverged"},
                   {"first failed runs", Align::left},
                   {"parameter most tied to failing", Align::left}};
  for (std::size_t p = 0; p < results.statistics.size(); ++p) {
    const mc::PointStatistics& point = results.statistics[p];
    const auto& failures = point.failures();
    const auto diverged = failures.by_status().find(mc::RunStatus::filter_diverged);
    const std::uint64_t count = diverged == failures.by_status().end() ? 0 : diverged->second;
    if (failures.lost().hits == 0 && count == 0) continue;
    const auto deciles = failures.deciles();
    const auto most = std::ranges::max_element(deciles, {}, &mc::FailureStatistics::Deciles::chi2);
    // Bonferroni over the parameters at 1 %: chi-square of 9 degrees beyond 33 to 37 for 60 or 300.
    constexpr double surely = 37.0;
    const std::string tied =
        most == deciles.end() || most->chi2 < surely
            ? "none"
            : fmt::format("{} (lowest tenth {} %, highest {} %)",
                          TermLibrary::specs[most->param].key.view(),
                          percent(most->rate.front().value()), percent(most->rate.back().value()));
    std::string runs;
    for (const auto run : failures.first_failed())
      runs += fmt::format("{}{}", runs.empty() ? "" : " ", run);
    table.add({results.points[p].label.empty() ? "the study" : results.points[p].label,
               fmt::format("{}", point.runs()),
               {percent_text(failures.lost()), failures.too_many() ? Tone::bad : Tone::plain},
               fmt::format("{}", count),
               runs,
               {tied, tied == "none" ? Tone::plain : Tone::bad}});
  }
  table.note =
      "Lost runs have no data. Where failing depends on a parameter, statistics over the runs that "
      "are left are "
      "biased: above 1 % lost there is no headline.";
  return table;
}

}  // namespace drift::report
