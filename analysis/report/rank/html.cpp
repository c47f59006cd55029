#include <fmt/format.h>

#include "analysis/report/rank/report.hpp"
#include "analysis/report/rank/tables.hpp"
#include "core/base/results_folder.hpp"

namespace drift::report {
namespace {

Section group_section(const mc::Study& study, const planning::RankingGroup& group) {
  Section s{fmt::format("Filter {}", group.filters), {}};
  s.blocks.emplace_back(
      Picture{learning_figure(group), "Longer is better known. Each bar is one equation."});
  s.blocks.emplace_back(ranking_table(group));
  if (group.models.size() > 1) s.blocks.emplace_back(coupling_table(group));
  for (const planning::ModelRanking& m : group.models) s.blocks.emplace_back(elsewhere_table(m));
  s.blocks.emplace_back(Picture{spectrum_figure(group),
                                "Prior-scaled eigenvalues of the information. Below 0 the prior "
                                "says more than the data; -12 stands for anything less."});
  for (const planning::ModelRanking& m : group.models) s.blocks.emplace_back(null_table(m));
  for (const planning::ModelRanking& m : group.models) s.blocks.emplace_back(direction_table(m));
  for (const planning::ModelRanking& m : group.models) {
    s.blocks.emplace_back(
        Picture{position_figure(study, m),
                "Bits of each parameter that each position adds, positions taken in their order."});
    s.blocks.emplace_back(position_table(study, m));
    s.blocks.emplace_back(
        Picture{time_figure(m),
                "The same by time; columns are named by position and the minute they end at."});
    s.blocks.emplace_back(minutes_table(study, m));
  }
  for (const planning::ModelRanking& m : group.models) {
    s.blocks.emplace_back(method_table(m));
    s.blocks.emplace_back(Sentences{disagreements(m)});
  }
  return s;
}

Section improvement_section(const mc::Study& study, const planning::PlanRanking& rank) {
  Section s{"A better plan", {}};
  s.blocks.emplace_back(improvement_table(rank));
  if (rank.better->improvement.steps.empty()) return s;
  s.blocks.emplace_back(Picture{improvement_figure(rank),
                                "Expected gain of each parameter from all proposed positions."});
  s.blocks.emplace_back(gain_table(rank));
  s.blocks.emplace_back(Preformatted{proposed_toml(study, rank)});
  return s;
}

Section study_section(const mc::Study& study) {
  Table table;
  table.columns = {{"key", Align::left}, {"value", Align::left}, {"from", Align::left}};
  for (const mc::Resolved& r : study.resolved) table.add({r.key, r.value, r.origin});
  return {"Study",
          {Paragraph{"Every value the study resolves to, and where it comes from."}, table}};
}

}  // namespace

HtmlReport rank_html(const mc::Study& study, const planning::PlanRanking& rank) {
  HtmlReport report;
  report.title = study.title.empty() ? "Observability ranking" : study.title;
  report.subtitle = plan_line(study, rank);
  report.headlines = headlines(study, rank);
  for (const planning::RankingGroup& g : rank.groups)
    report.sections.push_back(group_section(study, g));
  if (rank.better) report.sections.push_back(improvement_section(study, rank));
  if (!study.resolved.empty()) report.sections.push_back(study_section(study));
  report.footer =
      "Written by driftscope rank. Nothing is sampled: sigmas are Cramer-Rao bounds with the "
      "prior.";
  return report;
}

std::vector<std::string> write_results(const mc::Study& study, const planning::PlanRanking& rank,
                                       const std::string& folder) {
  std::vector<TextFile> files;
  files.emplace_back("rank.json", to_json(study, rank));
  for (std::size_t g = 0; g < rank.groups.size(); ++g) {
    const planning::RankingGroup& group = rank.groups[g];
    const std::string number = rank.groups.size() > 1 ? fmt::format("_{}", g + 1) : "";
    files.emplace_back(fmt::format("learning{}.svg", number), learning_figure(group));
    files.emplace_back(fmt::format("spectrum{}.svg", number), spectrum_figure(group));
    files.emplace_back(fmt::format("positions{}.svg", number),
                       position_figure(study, group.models.front()));
  }
  if (rank.better && !rank.better->improvement.steps.empty()) {
    files.emplace_back("improvement.svg", improvement_figure(rank));
    files.emplace_back("proposed_positions.toml", proposed_toml(study, rank));
  }
  files.emplace_back("report.html", to_html(rank_html(study, rank)));
  if (!study.text.empty()) files.emplace_back("study.toml", study.text);
  return write_files(files, folder);
}

}  // namespace drift::report
