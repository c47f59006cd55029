#pragma once

#include <string>
#include <vector>

#include "analysis/blind/rivals/score_rivals.hpp"
#include "analysis/blind/summary.hpp"
#include "analysis/report/page/report.hpp"

namespace drift::report {

/// A blind study: its scores, and the hashes that are published with them.
struct BlindResults {
  std::string title;
  blind::Summary summary;
  std::vector<blind::TrialScore> scores;
  std::string key_hash = {}, answers_hash = {};
  std::vector<blind::RivalScore> rivals = {};  ///< where they were asked for
};

/// All a blind study has to say: tables, pictures and blind.json with hashes, targets, all scores,
/// every trial.
Report blind_report(const BlindResults& results);

}  // namespace drift::report
