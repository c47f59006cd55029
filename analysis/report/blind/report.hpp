#pragma once

#include <string>
#include <vector>

#include "analysis/blind/summary.hpp"

namespace drift::report {

/// What is published with the scores.
struct Hashes {
  std::string key, answers;
};

/// For a terminal.
std::string to_text(const blind::Summary& summary, const std::vector<blind::TrialScore>& scores,
                    const Hashes& hashes);
/// blind.json: hashes, targets, all scores, every trial.
std::string to_json(const blind::Summary& summary, const std::vector<blind::TrialScore>& scores,
                    const Hashes& hashes);

/// Writes blind.json, report.html, power.svg, confusion.svg, pulls.svg, time.svg. Returns their
/// names.
std::vector<std::string> write_report(const std::string& title, const blind::Summary& summary,
                                      const std::vector<blind::TrialScore>& scores,
                                      const Hashes& hashes, const std::string& folder);

}  // namespace drift::report
