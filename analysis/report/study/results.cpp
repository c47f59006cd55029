#include "analysis/report/study/results.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/report/page/swept_value.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/number_text.hpp"
#include "core/physics/parameters_config.hpp"
#include "mc/study/own_terms_on_plan.hpp"

namespace drift::report {

std::uint64_t all_runs(const StudyResults& results) {
  std::uint64_t runs = 0;
  for (const mc::PointStatistics& s : results.statistics) runs += s.runs();
  return runs;
}

std::string unfinished_text(const StudyResults& results) {
  if (results.unfinished.empty()) return "";
  const auto none = static_cast<std::size_t>(std::ranges::count_if(
      results.unfinished, [&](std::size_t p) { return results.statistics[p].runs() == 0; }));
  const std::size_t points = results.points.size(), lack = results.unfinished.size();
  std::string text =
      fmt::format("The study is not finished: {} of {}{} runs are there", all_runs(results),
                  results.study.monte_carlo.stop ? "at most " : "", results.asked * points);
  const auto of_points = [&](std::size_t count, std::string_view which) {
    text += fmt::format("; {} of {} study points {}", count, points, which);
  };
  if (points > 1 && none > 0) of_points(none, none == 1 ? "has none" : "have none");
  if (points > 1 && lack > none)
    of_points(lack - none, lack - none == 1 ? "lacks some" : "lack some");
  return text + ". What is said is of these runs.";
}

std::vector<Pair> pairs_of(const StudyResults& results) {
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < results.statistics.size(); ++p)
    for (std::size_t f = 0; f < results.statistics[p].filters().size(); ++f)
      pairs.push_back({p, f});
  return pairs;
}

const mc::FilterStatistics& statistics_of(const StudyResults& results, const Pair& pair) {
  return results.statistics[pair.point].filters()[pair.filter];
}

mc::LeftOut left_out(const StudyResults& results, const Pair& pair) {
  return mc::left_out(results.points[pair.point].study, pair.filter);
}

bool matched(const StudyResults& results, const Pair& pair) {
  return left_out(results, pair).nothing();
}

std::vector<std::string> missing_in(const mc::LeftOut& l) {
  std::vector<std::string> missing = terms_text(TermLibrary::completed(l.parameters));
  missing.insert(missing.end(), l.noise.begin(), l.noise.end());
  return missing;
}

std::vector<std::string> smaller_in(const mc::LeftOut& l) {
  std::vector<std::string> smaller = keys_of(l.smaller);
  smaller.insert(smaller.end(), l.smaller_keys.begin(), l.smaller_keys.end());
  return smaller;
}

std::vector<std::string> keys_of(const ParamMask& params) {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < params.size(); ++i)
    if (params[i]) keys.push_back(parameter_key(i));
  return keys;
}

std::string model_in_words(const mc::LeftOut& l) {
  if (l.nothing()) return "the right model";
  std::vector<std::string> parts;
  if (l.equation) parts.emplace_back("the wrong equation");
  const std::vector<std::string> missing = missing_in(l);
  if (!missing.empty())
    parts.push_back(fmt::format("without {} of the truth", fmt::join(missing, ", ")));
  if (l.held.any())
    parts.push_back(
        fmt::format("with {} at other values than the truth", fmt::join(keys_of(l.held), ", ")));
  const std::vector<std::string> smaller = smaller_in(l);
  if (!smaller.empty())
    parts.push_back(fmt::format("with {} smaller than the truth's", fmt::join(smaller, ", ")));
  if (l.excluded.any())
    parts.push_back(fmt::format("with prior{} of {} that exclude{} the truth",
                                plural(l.excluded.count()), fmt::join(keys_of(l.excluded), ", "),
                                l.excluded.count() == 1 ? "s" : ""));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::uint64_t diverged_runs(const mc::FailureStatistics& failures) {
  const auto diverged = failures.by_status().find(mc::RunStatus::filter_diverged);
  return diverged == failures.by_status().end() ? 0 : diverged->second;
}

std::vector<std::string> broken_terms(const StudyResults& results) {
  std::vector<std::string> told;
  for (std::size_t p = 0; p < results.points.size(); ++p) {
    const mc::FailureStatistics& failures = results.statistics[p].failures();
    if (failures.lost().hits == 0 && diverged_runs(failures) == 0) continue;
    for (mc::BrokenTerm& term : mc::broken_own_terms(results.points[p].study))
      if (std::ranges::find(told, term.what) == told.end()) told.push_back(std::move(term.what));
  }
  return told;
}

std::string condition_of(const mc::StudyPoint& point) {
  std::string text;
  for (const auto& [key, value] : point.values)
    if (key != "truth.coupling")
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, short_value(value));
  return text;
}

namespace {

/// One of a percentage, or as many as leave two digits of a share or an interval below 0.1 %.
int decimals_of_percent(double share) {
  const double percent = 100.0 * share;
  return percent > 0.0 && percent < 0.1 ? 1 - static_cast<int>(std::floor(std::log10(percent))) : 1;
}

/// Of filters from their first start; the first of several.
std::size_t most_silent_point(const StudyResults& results) {
  std::size_t worst = 0;
  double most = -1.0;
  for (const Pair& pair : pairs_of(results)) {
    const stats::Rate& silent = statistics_of(results, pair).starts().front().silent;
    if (silent.of == 0 || !(silent.value() > most)) continue;
    most = silent.value();
    worst = pair.point;
  }
  return worst;
}

}  // namespace

std::vector<std::size_t> pictured_points(const StudyResults& results) {
  constexpr std::size_t most = 4;
  const std::size_t n = results.statistics.size();
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < std::min(n, most); ++k)
    points.push_back(n <= most ? k : k * (n - 1) / (most - 1));
  if (n <= most) return points;
  const std::size_t worst = most_silent_point(results);
  const auto at = std::ranges::lower_bound(points, worst);
  if (at == points.end() || *at != worst) points.insert(at, worst);
  return points;
}

std::string not_pictured_text(const StudyResults& results) {
  const std::size_t all = results.points.size(), shown = pictured_points(results).size();
  if (shown >= all) return "";
  return fmt::format(
      "Pictures are of {} of the {} study points: some from the first to the last, and the one "
      "with the most silent failures ({}). {} not shown; numbers of all are in summary.json.",
      shown, all, name_of(results, most_silent_point(results)),
      all - shown == 1 ? "One is" : fmt::format("{} are", all - shown));
}

std::string name_of(const StudyResults& results, std::size_t point) {
  const std::string condition = condition_of(results.points[point]);
  return fmt::format("truth {}{}{}", key_of(results.points[point].study.truth.coupling),
                     condition.empty() ? "" : ", ", condition);
}

std::string label_of(const StudyResults& results, const Pair& pair) {
  const std::string condition = condition_of(results.points[pair.point]);
  return fmt::format("{} > {}{}{}", key_of(results.points[pair.point].study.truth.coupling),
                     statistics_of(results, pair).columns().name, condition.empty() ? "" : ", ",
                     condition);
}

Cell rate_cell(const stats::Rate& rate, Tone tone) {
  if (rate.of == 0) return "-";
  const int decimals = decimals_of_percent(rate.high() - rate.low());
  return {rate.value(),
          fmt::format("{0:.{3}f} % ({1:.{3}f} to {2:.{3}f})", 100.0 * rate.value(),
                      100.0 * rate.low(), 100.0 * rate.high(), decimals),
          tone};
}

Cell percent_cell(double share) {
  return {share,
          std::isfinite(share) ? decimal_text(100.0 * share, decimals_of_percent(share)) : "-"};
}

std::size_t worst_parameter(const mc::FilterStatistics& filter, double claims) {
  std::size_t worst = filter.errors().size();
  double largest = 0.0;
  for (std::size_t k = 0; k < filter.errors().size(); ++k) {
    const mc::ErrorStatistics& e = filter.errors()[k];
    if (!(e.learning() < claims) || !(e.deception().value > largest)) continue;
    largest = e.deception().value;
    worst = k;
  }
  return worst;
}

double coverage_of_claims(const mc::FilterStatistics& filter, double claims) {
  double sum = 0.0;
  int n = 0;
  for (const mc::ErrorStatistics& e : filter.errors())
    if (e.learning() < claims) {
      sum += e.coverage()[1].value();
      ++n;
    }
  return n > 0 ? sum / n : std::nan("");
}

std::string key_at(const mc::FilterStatistics& filter, std::size_t k) {
  return parameter_key(filter.columns().layout, k);
}

}  // namespace drift::report
