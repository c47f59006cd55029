#pragma once

#include <string>

#include "mc/engine/engine.hpp"
#include "mc/store/study_reader.hpp"
#include "tests/support/synthetic_task.hpp"

namespace drift::test {

/// A study of cheap runs, executed and read in this process.
struct SyntheticStudy {
  SyntheticOptions task = {};
  std::size_t points = 1;
  mc::StopRules rules = {};
  mc::EngineOptions options = {.runs = 300};
  std::size_t block_size = 64;
  std::string text = "synthetic";

  mc::StudyWork work() const {
    mc::StudyWork w;
    for (std::size_t p = 0; p < points; ++p) {
      SyntheticOptions o = task;
      o.scale = 1.0 + static_cast<double>(p);
      w.points.push_back({"point " + std::to_string(p), std::make_unique<SyntheticTask>(o)});
    }
    w.stop_rules = rules;
    return w;
  }
  mc::Manifest manifest() const {
    const mc::StudyWork w = work();
    mc::Manifest m = mc::make_manifest({text, task.seed, block_size}, text, w.points);
    m.runs = options.runs;
    return m;
  }
  mc::StudyOutcome run(const std::string& folder, const mc::ProgressSink& progress = {}) const {
    const mc::StudyWork w = work();
    const mc::Manifest m = manifest();
    mc::claim_folder(folder, m);
    mc::Ranks ranks;
    return mc::run_study(w, options, folder, m, ranks, progress);
  }
};

}  // namespace drift::test
