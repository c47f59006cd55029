#pragma once

#include <set>
#include <string>
#include <vector>

#include "mc/store/study_reader.hpp"
#include "mc/study/sweep.hpp"

namespace drift::mc {

/// A name that every reader takes as it is: letters, digits and _ ; "eq5/0/sigma/D_I_z" becomes
/// "eq5_0_sigma_D_I_z".
std::string plain_name(std::string_view name);
/// The same of several, none of them twice nor one of those taken: "a b" and "a_b" become "a_b" and
/// "a_b_2".
std::vector<std::string> plain_names(const std::vector<std::string>& names,
                                     std::set<std::string> taken = {});

/// A value in the unit in which people read it.
inline double in_column_unit(double value, const Column& column) {
  return value / column.unit.to_si;
}

/// Writes all results as CSV: `# key: value` lines of provenance, one header row "name [unit]", one
/// row per run with point, run and status first, then what was swept (study_points; may be empty),
/// and last when and why it failed. Missing is "nan". Points with different columns leave those of
/// others empty. Shortest digits that read back as the same number. Bounded memory; the file is
/// complete or not there. InputError (io).
void export_csv(StudyReader& reader, const StopRules& rules, const std::string& path,
                const std::vector<StudyPoint>& study_points);

/// The same as JSON: {"provenance": {...}, "points": [{"label", "swept": {key: value},
/// "columns": [{"name", "unit"}], "runs": [[run, "status", values...], ...],
/// "failures": [{"run", "status", "t_s", "cause"}, ...]}]}; missing is null.
void export_json(StudyReader& reader, const StopRules& rules, const std::string& path,
                 const std::vector<StudyPoint>& study_points);

/// The study_hash that a CSV or JSON export at this path carries; empty if it is none.
std::string study_hash_of_text(const std::string& path);

/// "ok", "integrator_failed", ...
const char* name(RunStatus status);
inline constexpr int num_statuses = 6;

/// Where a folder's results come from: study, its hash, sessions; and how many runs the worker
/// files list, by which readers of an export know whether more were stored since.
Facts provenance_of(StudyReader& reader);

}  // namespace drift::mc
