#pragma once

#include <string>
#include <vector>

#include "analysis/diagnosis/findings/diagnosis.hpp"
#include "analysis/report/page/report.hpp"
#include "mc/study/study.hpp"

namespace drift::report {

/// What the report says beside the diagnosis: where it came from.
struct DiagnosisSource {
  std::vector<std::string> recordings;  ///< files
  std::string details;                  ///< kept as written, fixed width; may be empty
  Provenance provenance = {};
  std::vector<Section> more = {};  ///< at the end of what a diagnosis says
};

/// All there is to say of a diagnosis, with its pictures; diagnosis.json, residual_signal.csv,
/// study.toml, patched.toml (where a cause is in the model; of an ambiguous verdict the most
/// probable one, said in a comment on top), advised.toml (the study with the positions of the
/// first advice) and corrected.toml (the study with the headings of the recording, where they are
/// others). InputError (config) as mc::require_own_terms().
Report diagnosis_report(const mc::Study& study, const diagnosis::Diagnosis& diagnosis,
                        const DiagnosisSource& source);

/// The answer in brief.
InBrief diagnosis_in_brief(const diagnosis::Diagnosis& diagnosis);

/// The same on one screen of a terminal, for a test engineer: verdict, where, causes, the strongest
/// candidates, before and after, what moved, noise that is not as declared, advice.
std::string to_text(const diagnosis::Diagnosis& diagnosis);

/// diagnosis.json, schema 1. Values stand in the unit named beside them; what is
/// not a finite number is null. Of causes `set` (causes with the same
/// number act together), of candidates the numbers of the table, and of several recordings the
/// window's `recording` with its own times, and `noise`, `equations`, `inseparable`, `remarks`,
/// `seconds`.
std::string to_json(const diagnosis::Diagnosis& diagnosis);

/// Writes the report, and what is to stand beside it, into a folder, made if need be, all or
/// nothing. A patched.toml, advised.toml or corrected.toml of an earlier diagnosis that this one
/// does not have is removed. Returns the names of the files. InputError (io) if one cannot be
/// written.
std::vector<std::string> write_results(const mc::Study& study,
                                       const diagnosis::Diagnosis& diagnosis,
                                       const DiagnosisSource& source, const std::string& folder,
                                       const std::vector<TextFile>& beside = {});

}  // namespace drift::report
