#include "analysis/report/study/report.hpp"

#include <algorithm>

#include "analysis/report/study/sections.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::report {

Section promised(const StudyResults& results) {
  return results.information;
}

Section provenance(const StudyResults& results) {
  Table table("", "<what | <value");
  for (const auto& [key, value] : results.provenance) table.add({key, value});
  return {"Provenance", {table, Preformatted{results.study.text}}, On::page};
}

Report study_report(const StudyResults& results) {
  mc::require_own_terms(results.study);
  Report report{.command = "run"};
  report.title = results.study.title.empty() ? "Monte Carlo study" : results.study.title;
  const std::size_t points = results.points.size();
  report.subtitle =
      fmt::format("{}{} run{} at {} study point{}, seed {}", all_runs(results),
                  results.unfinished.empty() ? "" : fmt::format(" of {}", results.asked * points),
                  plural(results.unfinished.empty() ? all_runs(results) : results.asked * points),
                  points, plural(points), results.study.monte_carlo.seed);
  report.headlines = headlines(results, most_headlines);
  report.brief = study_in_brief(results);
  report.add(sections_of(results, study_sections));
  report.document = {"summary.json", study_json(results, report.sections)};
  report.footer = fmt::format(
      "Intervals hold with 95 %{}",
      results.study.monte_carlo.design == mc::DesignKind::random
          ? "."
          : " for random designs; with this one they are conservative for means and rates.");
  return report;
}

std::vector<std::pair<std::size_t, std::uint64_t>> runs_to_trace(const StudyResults& results) {
  std::vector<std::pair<std::size_t, std::uint64_t>> runs;
  for (const std::size_t p : pictured_points(results))
    for (std::uint64_t run = 0; run < std::min<std::uint64_t>(3, results.statistics[p].runs());
         ++run)
      runs.emplace_back(p, run);
  return runs;
}

}  // namespace drift::report
