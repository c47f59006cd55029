#include "analysis/report/identify/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "analysis/report/identify/results_out.hpp"
#include "analysis/report/identify/sections.hpp"
#include "analysis/report/page/planned_study.hpp"
#include "analysis/report/page/study_section.hpp"
#include "core/base/sha256.hpp"
#include "core/recording/recording_output.hpp"
#include "mc/study/own_terms_check.hpp"

namespace drift::report {
namespace {

constexpr const char* corrected = "corrected.toml";  ///< where the plan was not the recording's

/// From what and with what a report was made, as an export of a study says it (provenance_of()).
mc::Facts facts_of(const Report& report) {
  mc::Facts facts = mc::provenance();
  std::string recordings;
  for (const SourceFile& file : report.provenance.recordings)
    recordings += fmt::format("{}{} {}", recordings.empty() ? "" : "\n", file.sha256, file.path);
  if (!recordings.empty()) facts.emplace_back("recordings", recordings);
  const auto study = std::ranges::find(report.files, "study.toml", &TextFile::first);
  if (study == report.files.end()) return facts;
  facts.insert(facts.begin(), {"study_sha256", sha256_hex(study->second)});
  facts.emplace_back("study", study->second);
  return facts;
}

}  // namespace

Report identification_report(const mc::Study& study, const identification::Identification& id) {
  mc::require_own_terms(study);
  Report report{.command = "identify"};
  report.title = study.title.empty() ? "Identification" : study.title;
  report.subtitle = id.simulated
                        ? fmt::format("Simulated, truth {}: {}", key_of(study.truth.coupling),
                                      equation_of(study.truth.coupling))
                        : fmt::format("Recording {}", fmt::join(id.sources, ", "));
  report.headlines = headlines(study, id);
  report.order = Order::headlines_last;
  report.brief = identification_in_brief(study, id);
  Json document = identification_document(study, id);
  const std::vector<Table> published = published_comparison(study, id);
  const Blocks blocks(published.begin(), published.end());
  report.add({estimate_figures(study, id),
              {"Published results beside ours", blocks, On::page, Part::details}});
  for (std::size_t f = 0; f < id.summaries.size(); ++f) {
    const FilterView view{study, id, id.summaries[f]};
    const auto sections = sections_of(view, filter_sections, view.spec().name);
    add_tables(document["filters"][f], sections);
    report.add(sections);
  }
  // The terminal has had them before the answer.
  if (!id.remarks.empty()) report.add({{"To be kept in mind", {Sentences{id.remarks}}, On::page}});
  report.add({{"", blocks, On::terminal}, study_section(study)});
  report.footer = "Values stand with their units; ± is 1 sigma.";
  report.document = {"identification.json", dumped(document)};
  if (!study.text.empty()) report.files.emplace_back("study.toml", study.text);
  for (const identification::FilterSummary& s : id.summaries)
    if (s.heading_doubt && !study.text.empty()) {
      report.files.push_back(
          study_file_with_positions(corrected, study, s.heading_doubt->positions));
      break;
    }
  return report;
}

std::vector<std::string> write_identification(const Report& report,
                                              const identification::Identification& id,
                                              const std::string& folder) {
  Report all = report;
  std::ranges::move(result_tables(id), std::back_inserter(all.files));
  NewResults results({folder, report.command});
  add_report(results, all);
  if (std::ranges::find(all.files, corrected, &TextFile::first) == all.files.end())
    results.remove(corrected);
  const std::string arrays = "identification.nc";
  results.add(arrays, [&](const std::string& temporary) {
    write_identification_netcdf(id, facts_of(report), arrays, temporary);
  });
  const bool several = id.recordings.size() > 1;
  const auto name_of = [](std::size_t k) { return fmt::format("recording_{}.csv", k + 1); };
  // Those of an earlier call that had others.
  if (several) results.remove("recording.csv");
  for (std::size_t k = several ? id.recordings.size() : 0;
       std::filesystem::exists(std::filesystem::path(folder) / name_of(k)); ++k)
    results.remove(name_of(k));
  for (std::size_t k = 0; k < id.recordings.size(); ++k) {
    if (id.recordings[k].rows() == 0) continue;
    const std::string name = several ? name_of(k) : "recording.csv";
    results.add(name, [&](const std::string& temporary) {
      write_recording_to(id.recordings[k], name, temporary);
    });
  }
  return results.commit();
}

}  // namespace drift::report
