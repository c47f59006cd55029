#include "analysis/cli/study_program.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/cli/answer.hpp"
#include "analysis/report/study/report.hpp"
#include "mc/engine/study_work.hpp"
#include "mc/store/provenance.hpp"

namespace drift::cli {
namespace {

/// Where the time of all sessions went.
void add_speed(mc::StudyReader& reader, mc::Facts& facts) {
  double integration = 0.0, filter = 0.0, total = 0.0;
  std::uint64_t runs = 0;
  for (const mc::BlockKey& key : reader.keys())
    if (const auto block = reader.read(key.point, key.first)) {
      integration += block->times.integration_s;
      filter += block->times.filter_s;
      total += block->times.total_s;
      runs += block->block.status.size();
    }
  if (total > 0.0)
    facts.emplace_back(
        "speed",
        fmt::format("{:.1f} runs/s per core; filters {:.1f} %, integration {:.1f} %, rest {:.1f} %",
                    static_cast<double>(runs) / total, 100.0 * filter / total,
                    100.0 * integration / total,
                    100.0 * std::max(0.0, total - filter - integration) / total));
}

void present(const mc::Study& study, const mc::StudyWork& work, mc::StudyReader& reader,
             const std::string& folder) {
  report::StudyResults results;
  results.study = study;
  results.points = mc::study_points(study);
  for (const mc::StudyPoint& p : results.points) results.statistics.emplace_back(p.study);
  results.asked = reader.runs();
  for (std::size_t p = 0; p < results.points.size(); ++p) {
    mc::PointStatistics& here = results.statistics[p];
    const bool by_rule = reader.each_result(work.stop_rules, p,
                                            [&](const mc::StoredBlock& b) { here.add(b.block); });
    if (!by_rule && here.runs() < results.asked) results.unfinished.push_back(p);
  }
  for (const auto& [point, run] : report::runs_to_trace(results))
    results.traces.push_back({point, run, mc::trace_run(results.points[point].study, run)});
  results.information = report::information_section(results, 0);
  results.provenance = mc::provenance();
  results.provenance.emplace_back("study hash", reader.manifest().hash);
  results.provenance.emplace_back("results", mc::results_digest(reader, work.stop_rules));
  add_speed(reader, results.provenance);
  const report::Report said =
      with_provenance(report::study_report(results), report::provenance_of(study.path, {}));
  std::string details = report::to_text(said, report::study_width);
  if (results.provenance.back().first == "speed")
    details += fmt::format("\nspeed: {}\n", results.provenance.back().second);
  show_answer(said.brief,
              {details, folder, report::write_report(said, folder), said.document.second});
}

}  // namespace

StudyProgram study_program() {
  return {mc::work_of, present, mc::study_points};
}

}  // namespace drift::cli
