#pragma once

#include <limits>
#include <optional>

#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"
#include "analysis/report/study/report.hpp"

namespace drift::report {

/// What is said of a study, in this order.
DRIFT_SECTIONS(StudyResults, study_sections, (sweep, evidence), (crossed, evidence),
               (ranking, details), (promised, details), (honesty, details), (scatter, details),
               (convergence, details), (parameters, details), (rate_course, how_sure),
               (failures, how_sure), (provenance, provenance));

/// How filters on a wrong equation, filters that leave something of the truth out and right ones
/// do, at their worst.
InBrief study_in_brief(const StudyResults& results);

/// What must not be missed, in words: for each truth and filter how often it fails, how often
/// silently, and where most. Refused, with the reason, where more than 1 % of the runs are lost.
/// Of more than `most` pairs the last line says how many are left.
std::vector<std::string> headlines(const StudyResults& results,
                                   std::size_t most = std::numeric_limits<std::size_t>::max());
inline constexpr std::size_t most_headlines = 12;  ///< above the tables of a report

/// How many times as large as their sigmas errors are, over all that a filter claims to know: the
/// root of NEES/dof; 1 where no truth tells, or where it may be chance (FitLimits::misfit).
double sigmas_off(const mc::StartStatistics& start);
inline constexpr double much_too_small = 2.0;  ///< of such a factor: the sigmas are not to be used

/// The parameter whose errors are most times as large as its sigma, of those that are
/// much_too_small and not by chance, whether the filter claims to know it or not.
struct FarOff {
  std::size_t parameter = 0;  ///< place in the layout
  double times = 1.0;
};
std::optional<FarOff> far_off(const mc::FilterStatistics& filter);
/// "M_y, which the filter does not claim to know", where it does in no run.
std::string far_off_text(const mc::FilterStatistics& filter, const FarOff& off);

/// Of the mean of a chi-square over its degrees of freedom: beyond, a misfit is seen in any table.
inline constexpr double evident_misfit = 1.1;

/// "plan.preset = six: truth eq5, filter legacy".
std::string pair_in_words(const StudyResults& results, const Pair& pair);

/// Text of summary.json: its points one by one, for a sweep may have thousands; then the tables of
/// the sections.
std::string study_json(const StudyResults& results, const std::vector<Section>& sections);

}  // namespace drift::report
