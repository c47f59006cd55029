#pragma once

#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "analysis/report/page/json.hpp"
#include "analysis/report/page/wording.hpp"

namespace drift::report {

/// What is said of a diagnosis, in this order.
DRIFT_SECTIONS(diagnosis::Diagnosis, diagnosis_sections, (verdict, evidence),
               (kept_in_mind, how_sure), (odds, how_sure), (where, evidence), (windows, details),
               (what, how_sure), (form_that_fits, evidence), (profiles, details),
               (likeness, details), (rivals, details), (fit, evidence), (moved, details),
               (whiteness, details), (normality, details), (noise, details), (advice, how_sure));

/// The verdict in a few words, for a page's subtitle.
std::string verdict_word(const diagnosis::Diagnosis& diagnosis);

/// "Verdict named: ...". A study that is not of the recording has a verdict of its own: what is
/// said of causes does not hold. (The JSON has its four words, `latitude` and `heading`.)
std::string headline(const diagnosis::Diagnosis& diagnosis);

/// Causes are told from a model without, before and after; of a consistent verdict on the page
/// alone.
inline On shown_of(const diagnosis::Diagnosis& d) {
  return d.verdict == diagnosis::Verdict::consistent ? On::page : On::both;
}

/// Every parameter of the causes with its interval.
Blocks cause_figure(const diagnosis::Diagnosis& diagnosis);

// Tables that stand in diagnosis.json too.
Table candidate_table(const diagnosis::Diagnosis& diagnosis);
Table moved_table(const diagnosis::Diagnosis& diagnosis);
Table noise_table(const diagnosis::Diagnosis& diagnosis);
Table window_table(const diagnosis::Where& where, TimeUnit axes = TimeUnit::seconds);

/// residual_signal.csv: the recovered inputs, row by row, with facts in comment lines: what is not
/// finite or not known is an empty cell, `explained` where no cause is named. Of several
/// recordings, whose times follow one another, a last column names the recording; a comment line
/// says what to subtract for its own time.
std::string residual_signal_csv(const std::vector<diagnosis::RecoveredSignal>& signals,
                                const std::vector<diagnosis::RecordingSpan>& recordings = {});

struct TimeAxis {
  double unit = 3600.0;  ///< [s]
  std::string label;
};
TimeAxis time_axis(const std::vector<double>& t, const diagnosis::Where& where);

/// Residuals of a channel as sorted, at most 150 of them with both ends, each beside the quantile
/// that a standard normal number has there.
std::vector<std::pair<double, double>> normal_quantiles(const MatX& residual, Eigen::Index channel);

/// `profiles` of diagnosis.json.
Json profiles_json(const std::vector<diagnosis::Profile>& profiles);

/// The facts about a proposed form; null without one.
Json form_json(const std::optional<diagnosis::Proposal>& proposal);

Json diagnosis_document(const diagnosis::Diagnosis& diagnosis);

}  // namespace drift::report
