#include "analysis/report/study/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/report/study/figures.hpp"
#include "analysis/report/study/json.hpp"
#include "analysis/report/study/sweep_figures.hpp"
#include "analysis/report/study/tables.hpp"
#include "core/base/results_folder.hpp"
#include "core/physics/coupling_text.hpp"

namespace drift::report {
namespace {

constexpr std::size_t most_pairs = 24;  ///< of which there is a table of parameters

std::string name_of(const mc::StudyPoint& point) {
  const std::string condition = condition_of(point);
  return fmt::format("truth {}{}{}", key_of(point.study.truth.coupling),
                     condition.empty() ? "" : ", ", condition);
}

/// The pair with the right filter of each pictured point; the first filter where none is right.
std::vector<Pair> ranked_pairs(const StudyResults& results) {
  std::vector<Pair> pairs;
  for (const std::size_t p : pictured_points(results)) {
    Pair best{p, 0};
    for (std::size_t f = results.statistics[p].filters().size(); f-- > 0;)
      if (matched(results, {p, f})) best.filter = f;
    pairs.push_back(best);
  }
  return pairs;
}

Section provenance_section(const StudyResults& results) {
  Table table;
  table.columns = {{"what", Align::left}, {"value", Align::left}};
  for (const auto& [key, value] : results.provenance) table.add({key, value});
  Section section{"Provenance", {table}};
  section.blocks.emplace_back(Preformatted{results.study.text});
  return section;
}

}  // namespace

HtmlReport study_html(const StudyResults& results) {
  HtmlReport report;
  report.title = results.study.title.empty() ? "Monte Carlo study" : results.study.title;
  std::uint64_t runs = 0;
  for (const auto& s : results.statistics) runs += s.runs();
  report.subtitle =
      fmt::format("{} runs at {} study point{}, seed {}", runs, results.points.size(),
                  results.points.size() == 1 ? "" : "s", results.study.monte_carlo.seed);
  report.headlines = study_headlines(results);
  report.sections.push_back(
      {"Truth against filter",
       {crossed_table(results), silent_failure_picture(results), start_table(results)}});
  if (auto pictures = sweep_pictures(results); !pictures.empty()) {
    Section section{"Sweep", {}};
    for (Picture& p : pictures) section.blocks.emplace_back(std::move(p));
    report.sections.push_back(std::move(section));
  }
  Section ranking{"Ranking by Monte Carlo", {}};
  if (const auto pictured = pictured_points(results); pictured.size() < results.points.size())
    ranking.blocks.emplace_back(Paragraph{
        fmt::format("From here on there are pictures of {} of the {} study points, from the "
                    "first to the last. Numbers of all are in summary.json.",
                    pictured.size(), results.points.size())});
  for (const Pair& pair : ranked_pairs(results))
    ranking.blocks.emplace_back(ranking_picture(results, pair));
  report.sections.push_back(std::move(ranking));
  report.sections.insert(report.sections.end(), results.further.begin(), results.further.end());
  Section scatter{"Error against sigma", {}}, convergence{"Convergence of sample runs", {}};
  for (const std::size_t p : pictured_points(results)) {
    scatter.blocks.emplace_back(Paragraph{name_of(results.points[p])});
    scatter.blocks.emplace_back(scatter_picture(results, p));
  }
  report.sections.push_back(std::move(scatter));
  for (std::size_t p = 0; p < results.points.size(); ++p) {
    if (std::ranges::none_of(results.traces, [&](const TracedRun& t) { return t.point == p; }))
      continue;
    convergence.blocks.emplace_back(Paragraph{name_of(results.points[p])});
    convergence.blocks.emplace_back(convergence_picture(results, p));
  }
  if (!convergence.blocks.empty()) report.sections.push_back(std::move(convergence));
  Section parameters{"Every parameter", {}};
  std::size_t shown = 0;
  for (const Pair& pair : pairs_of(results))
    if (shown++ < most_pairs) parameters.blocks.emplace_back(parameter_table(results, pair));
  if (shown > most_pairs)
    parameters.blocks.emplace_back(
        Paragraph{fmt::format("{} more tables are in summary.json.", shown - most_pairs)});
  report.sections.push_back(std::move(parameters));
  Table failures = failure_table(results);
  report.sections.push_back(
      {"Failures",
       {failures.rows.empty() ? Block(Paragraph{"Every run yielded data, and no filter diverged."})
                              : Block(std::move(failures))}});
  report.sections.push_back(provenance_section(results));
  report.footer = "Written by driftscope run. Intervals hold with 95 %";
  report.footer +=
      results.study.monte_carlo.design == mc::DesignKind::random
          ? "."
          : " for random designs; with this one they are conservative for means and rates.";
  return report;
}

std::string study_text(const StudyResults& results) {
  constexpr std::size_t width = 110;
  std::string out = wrapped(results.study.title, width) + "\n";
  for (const std::string& line : study_headlines(results)) out += wrapped("- " + line, width, 2);
  out += "\n" + text_of(crossed_table(results), width);
  if (const Table failures = failure_table(results); !failures.rows.empty())
    out += "\n" + text_of(failures, width);
  return out;
}

std::vector<std::pair<std::size_t, std::uint64_t>> runs_to_trace(const StudyResults& results) {
  std::vector<std::pair<std::size_t, std::uint64_t>> runs;
  for (const std::size_t p : pictured_points(results))
    for (std::uint64_t run = 0; run < std::min<std::uint64_t>(3, results.statistics[p].runs());
         ++run)
      runs.emplace_back(p, run);
  return runs;
}

std::vector<std::string> write_study_report(const StudyResults& results,
                                            const std::string& folder) {
  std::vector<TextFile> files;
  files.emplace_back("report.html", to_html(study_html(results)));
  files.emplace_back("summary.json", study_json(results));
  return write_files(files, folder);
}

}  // namespace drift::report
