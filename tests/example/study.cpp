// A Monte Carlo study from C++: in memory, and in a folder as `driftscope run` leaves it.
#include <fmt/core.h>

#include <cmath>

#include "mc/engine/engine.hpp"
#include "mc/engine/study_work.hpp"
#include "mc/statistics/point_statistics.hpp"
#include "mc/store/study_identity.hpp"
#include "mc/store/study_reader.hpp"
#include "mc/task/study_task.hpp"

namespace {

using namespace drift;

void show(const char* where, const mc::PointStatistics& statistics) {
  for (const mc::FilterStatistics& filter : statistics.filters()) {
    fmt::print("{}, {}, {} runs:", where, filter.columns().name, statistics.runs());
    for (std::size_t k = 0; k < filter.errors().size(); ++k) {
      const ParamSpec& spec = TermLibrary::specs[filter.columns().layout.params[k]];
      fmt::print(" {} {:.9g} {}", spec.key.view(),
                 filter.errors()[k].rmse().value / spec.unit.to_si, spec.unit.symbol.view());
    }
    fmt::print("\n");
  }
}

/// Run after run of a study without a sweep.
mc::PointStatistics in_memory(const mc::Study& study) {
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  mc::PointStatistics statistics(study);
  mc::Block block;
  for (block.first = 0; block.first < study.monte_carlo.runs; ++block.first) {
    block.rows.assign(task.columns().size(), std::nan(""));
    block.status = {worker->execute(block.first, block.rows).status};
    statistics.add(block);
  }
  return statistics;
}

/// What the folder has already is not executed again.
mc::PointStatistics in_folder(const mc::Study& study, const std::string& folder) {
  const mc::StudyWork work = mc::work_of(study);
  mc::Manifest manifest = mc::make_manifest(mc::identity_of(study), study.text, work.points);
  manifest.runs = study.monte_carlo.runs;
  mc::claim_folder(folder, manifest);
  mc::Ranks ranks;
  const mc::StudyOutcome outcome =
      mc::run_study(work, {.runs = study.monte_carlo.runs}, folder, manifest, ranks);
  fmt::print("complete {}, executed now {}, results {}\n", outcome.complete, outcome.done,
             outcome.digest);
  mc::PointStatistics statistics(study);
  mc::StudyReader reader(folder);
  reader.each_result(work.stop_rules, 0,
                     [&](const mc::StoredBlock& stored) { statistics.add(stored.block); });
  return statistics;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::runtime_error("usage: study STUDY.toml FOLDER");
  const mc::Study study = mc::read_study(argv[1], {{"monte_carlo.runs", "100"}});
  show("memory", in_memory(study));
  show("folder", in_folder(study, argv[2]));
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
