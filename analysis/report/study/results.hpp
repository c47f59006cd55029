#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/report/page/report.hpp"
#include "mc/statistics/point_statistics.hpp"
#include "mc/study/sweep.hpp"
#include "mc/task/left_out.hpp"
#include "mc/task/trace.hpp"

namespace drift::report {

/// A run executed again, for its convergence curves.
struct TracedRun {
  std::size_t point = 0;
  std::uint64_t run = 0;
  mc::RunTrace trace;
};

/// Everything a study report is made of.
struct StudyResults {
  mc::Study study;  ///< as given, with its sweep
  std::vector<mc::StudyPoint> points;
  std::vector<mc::PointStatistics> statistics;  ///< one per point
  std::uint64_t asked = 0;  ///< runs per point, with a stop rule at most; 0: those there are
  std::vector<std::size_t> unfinished;  ///< points with fewer, that no stop rule ended
  std::vector<TracedRun> traces;
  std::vector<std::pair<std::string, std::string>> provenance;  ///< shown as they are
  Section information;  ///< of information_section(); may be empty
};

/// Of all points.
std::uint64_t all_runs(const StudyResults& results);
/// "The study is not finished: 180 of 540 runs are there ..."; empty of a finished one.
std::string unfinished_text(const StudyResults& results);

/// One filter at one study point.
struct Pair {
  std::size_t point = 0, filter = 0;
};
std::vector<Pair> pairs_of(const StudyResults& results);

const mc::FilterStatistics& statistics_of(const StudyResults& results, const Pair& pair);

/// What of the truth the filter leaves out; nothing: it is the model that made the data.
mc::LeftOut left_out(const StudyResults& results, const Pair& pair);
bool matched(const StudyResults& results, const Pair& pair);

/// "the wrong equation, without sag of the truth"; "the right model" of a filter that leaves
/// nothing out. Terms stand as study files name them.
std::string model_in_words(const mc::LeftOut& left_out);
/// What is missing in it, as the "terms" of a study file would have it, and keys of its noise.
std::vector<std::string> missing_in(const mc::LeftOut& left_out);
/// Of which noise it has less than the truth: parameters and keys, "initial_attitude".
std::vector<std::string> smaller_in(const mc::LeftOut& left_out);
/// "W_tau" of each parameter.
std::vector<std::string> keys_of(const ParamMask& params);

/// Runs in which a filter diverged.
std::uint64_t diverged_runs(const mc::FailureStatistics& failures);

/// Own terms that are no finite number somewhere on the plan, of the points where runs were lost or
/// filters diverged: what may have ended these, each once.
std::vector<std::string> broken_terms(const StudyResults& results);

/// What tells a point from the others besides the truth's coupling: "plan.preset = six"; or empty.
std::string condition_of(const mc::StudyPoint& point);

/// The study points that pictures are drawn of: all, or four from the first to the last and, where
/// it is none of them, the one at which some filter fails silently most often.
std::vector<std::size_t> pictured_points(const StudyResults& results);
/// Which these are and how many are left out; empty if none.
std::string not_pictured_text(const StudyResults& results);

/// "truth eq5, plan.preset = six" of a point; "eq5 > legacy, plan.preset = six" of a pair.
std::string name_of(const StudyResults& results, std::size_t point);
std::string label_of(const StudyResults& results, const Pair& pair);

/// "91.5 % (86.8 to 94.6)"; "-" without runs.
Cell rate_cell(const stats::Rate& rate, Tone tone = Tone::plain);

/// "91.5" of a share of 0.915.
Cell percent_cell(double share);

/// The parameter a pair deceives about most: largest RMSE over sigma among those it claims to know.
/// Layout index; the size of the layout if it claims to know none.
std::size_t worst_parameter(const mc::FilterStatistics& filter, double claims);

/// Share of the errors within 2 sigma, over the parameters a filter claims to know; NaN of none.
double coverage_of_claims(const mc::FilterStatistics& filter, double claims);

/// "K3_x" of a layout index.
std::string key_at(const mc::FilterStatistics& filter, std::size_t k);

/// Of the prior's sigma: below, a filter claims to know a parameter.
inline double claims_of(const StudyResults& results) {
  return results.study.monte_carlo.healthy_sigma;
}

}  // namespace drift::report
