#include <algorithm>

#include "analysis/report/study/sections.hpp"

namespace drift::report {
namespace {

/// The parameter most tied to failing.
Cell tied_cell(const mc::FailureStatistics& failures) {
  // Bonferroni over the parameters at 1 %: chi-square of 9 degrees beyond 33 to 37 for 60 or 300.
  constexpr double surely = 37.0;
  const auto deciles = failures.deciles();
  const auto most = std::ranges::max_element(deciles, {}, &mc::FailureStatistics::Deciles::chi2);
  if (most == deciles.end() || most->chi2 < surely) return "none";
  return {fmt::format("{} (lowest tenth {} %, highest {} %)", parameter_key(most->param),
                      percent_cell(most->rate.front().value()).text,
                      percent_cell(most->rate.back().value()).text),
          Tone::bad};
}

}  // namespace

/// Lost and diverged runs, and whether they have to do with a parameter.
Section failures(const StudyResults& results) {
  Table table("Failures",
              "<study point | runs | lost | filter diverged | <first failed runs | "
              "<parameter most tied to failing",
              "Lost runs have no data. Where failing depends on a parameter, statistics over the "
              "runs that are left are biased: above 1 % lost there is no headline.");
  for (std::size_t p = 0; p < results.statistics.size(); ++p) {
    const auto& failed = results.statistics[p].failures();
    const std::uint64_t count = diverged_runs(failed);
    if (failed.lost().hits == 0 && count == 0) continue;
    table.add({results.points.size() == 1 ? "the study" : name_of(results, p),
               results.statistics[p].runs(),
               rate_cell(failed.lost(), failed.too_many() ? Tone::bad : Tone::plain), count,
               fmt::format("{}", fmt::join(failed.first_failed(), " ")), tied_cell(failed)});
  }
  if (!table.rows.empty()) {
    Section section{"Failures", {table}};
    if (Sentences broken{broken_terms(results)}; !broken.items.empty())
      section.add({std::move(broken)});
    return section;
  }
  return {"Failures", {Paragraph{"Every run yielded data, and no filter diverged."}}, On::page};
}

}  // namespace drift::report
