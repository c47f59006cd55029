#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/study/sections.hpp"

namespace drift::report {
namespace {

using mc::FilterStatistics;

/// What the share of wrong runs does not hold: a parameter that the filter does not claim to know.
std::string unclaimed_text(const FilterStatistics& filter) {
  const std::optional<FarOff> off = far_off(filter);
  if (!off || filter.health()[off->parameter].claims.hits > 0) return "";
  return fmt::format("; {}, is {} times its sigma off", far_off_text(filter, *off),
                     number_text(off->times, 3));
}

/// Of those that diverged there are no errors.
std::string diverged_text(const mc::StartStatistics& s) {
  return s.diverged.hits > 0 ? fmt::format("; {} of the runs diverged, errors are of the others",
                                           rate_cell(s.diverged).text)
                             : "";
}

/// What no single parameter shows: combinations that the filter claims to know.
std::string off_text(const mc::StartStatistics& s) {
  const double off = sigmas_off(s);
  return off > much_too_small ? fmt::format(
                                    "; combinations of parameters are off by {} times their sigma "
                                    "(root of NEES/dof)",
                                    number_text(off, 2))
                              : "";
}

std::string headline_of(const StudyResults& results, const Pair& pair) {
  const FilterStatistics& filter = statistics_of(results, pair);
  const mc::StartStatistics& s = filter.starts().front();
  const std::string start = pair_in_words(results, pair);
  const mc::LeftOut lacks = left_out(results, pair);
  if (lacks.nothing())
    return fmt::format(
        "{} ({}): 2 sigma hold {} % of the errors (95.4 expected) of what the filter claims to "
        "know; silent failures {}{}.",
        start, model_in_words(lacks),
        percent_cell(coverage_of_claims(filter, claims_of(results))).text, rate_cell(s.silent).text,
        off_text(s) + unclaimed_text(filter) + diverged_text(s));
  std::string text = fmt::format(
      "{} ({}): in {} of the runs some parameter that the filter claims to know is more than 5 "
      "sigma off{}; silent failures, where nothing in the run shows it: {}",
      start, model_in_words(lacks), rate_cell(s.wrong).text,
      s.diverged.hits > 0 ? ", or the filter diverged" : "", rate_cell(s.silent).text);
  const std::size_t k = worst_parameter(filter, claims_of(results));
  if (k < filter.errors().size())
    text += fmt::format("; worst {}: its error is {} times its sigma", key_at(filter, k),
                        number_text(filter.errors()[k].deception().value));
  return text + off_text(s) + unclaimed_text(filter) + diverged_text(s) + ".";
}

}  // namespace

double sigmas_off(const mc::StartStatistics& s) {
  const double nees = s.nees.mean();
  const bool chance = !(s.nees.sigmas_above() > inference::FitLimits::misfit);
  return std::isfinite(nees) && !chance ? std::sqrt(nees) : 1.0;
}

std::optional<FarOff> far_off(const FilterStatistics& filter) {
  std::optional<FarOff> worst;
  for (std::size_t k = 0; k < filter.errors().size(); ++k) {
    const mc::ErrorStatistics& e = filter.errors()[k];
    const double times = e.deception().value;
    if (times > (worst ? worst->times : much_too_small) &&
        e.sigmas_above() > inference::FitLimits::misfit)
      worst = FarOff{k, times};
  }
  return worst;
}

std::string far_off_text(const FilterStatistics& filter, const FarOff& off) {
  return key_at(filter, off.parameter) + (filter.health()[off.parameter].claims.hits > 0
                                              ? ""
                                              : ", which the filter does not claim to know");
}

std::string pair_in_words(const StudyResults& results, const Pair& pair) {
  const std::string condition = condition_of(results.points[pair.point]);
  return fmt::format("{}truth {}, filter {}", condition.empty() ? "" : condition + ": ",
                     key_of(results.points[pair.point].study.truth.coupling),
                     statistics_of(results, pair).columns().name);
}

std::vector<std::string> headlines(const StudyResults& results, std::size_t most) {
  std::vector<Pair> pairs = pairs_of(results);
  std::erase_if(pairs, [&](const Pair& p) { return results.statistics[p.point].runs() == 0; });
  // The wrong pairs first, by falling silent failure rate.
  std::ranges::stable_sort(pairs, {}, [&](const Pair& p) {
    const stats::Rate& silent = statistics_of(results, p).starts().front().silent;
    return std::pair(matched(results, p), silent.of > 0 ? -silent.value() : 0.0);
  });
  std::vector<std::string> lines;
  std::vector<std::size_t> refused;
  std::size_t said = 0, left = 0;
  for (const Pair& pair : pairs) {
    const auto& failures = results.statistics[pair.point].failures();
    if (!failures.too_many()) {
      if (said == most)
        ++left;
      else
        lines.push_back(headline_of(results, pair)), ++said;
    } else if (std::ranges::find(refused, pair.point) == refused.end()) {
      refused.push_back(pair.point);
      lines.push_back(
          fmt::format("No headline for {}: {} of the runs were lost, and what is left may be a "
                      "biased choice. See Failures.",
                      results.points.size() == 1 ? "this study" : name_of(results, pair.point),
                      rate_cell(failures.lost()).text));
    }
  }
  if (left > 0)
    lines.push_back(
        fmt::format("And {} more pair{} of point and filter: see the tables.", left, plural(left)));
  return lines;
}

}  // namespace drift::report
