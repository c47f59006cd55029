#pragma once

#include <optional>
#include <vector>

#include "analysis/diagnosis/findings/fit_comparison.hpp"
#include "analysis/diagnosis/findings/remark.hpp"
#include "analysis/diagnosis/findings/verdict.hpp"
#include "analysis/search/posterior.hpp"

namespace drift::diagnosis {

/// Each of several simultaneous causes judged by itself: what the held-out prediction of all
/// positions loses (log score) when the model is fitted again without it. In the order of
/// `best.choices`; empty for one cause.
std::vector<double> judge_members(const search::Fitted& nominal, const MeasuredTest& test,
                                  const search::Refit& best, const search::Search& found);

/// The verdict, and why it is no better.
struct Judged {
  Verdict verdict = Verdict::consistent;
  std::vector<Remark> remarks;
  std::optional<remark::DrivesOneGyro> one_gyro;  ///< why it is `unexplained`, if that is why
  /// Why it is `ambiguous` though nothing is significant, if it is.
  std::optional<remark::LikelierMissing> likelier_missing;
  /// Of `unexplained`: the chance that the rows are of the noise that was found, by which they are
  /// not.
  std::optional<double> of_no_noise;
  /// Whether what was found stands in the mean, or would: not where nothing is significant.
  bool names_causes() const { return verdict != Verdict::consistent && !likelier_missing; }
};

/// Whether a cause must predict held-out positions better to be named.
enum class NamedBy { held_out, fit_alone };

/// What is significant is an alarm only if the probabilities agree: not where nothing missing is
/// the more probable, or, where noise not as declared explains what a cause does or priors that are
/// wrong do, has SearchLimits::credible of them. A cause is named only where nothing missing is not
/// credible, and the other way round about the priors of the nominal model is not. The other way
/// round, what is not significant is `ambiguous`, without a cause, where the probabilities have it
/// that something is missing, credibly (SearchLimits::credible). Where nothing is
/// found but the rows are not of the noise that was found either (one more factor of noise would be
/// a million times as likely, its price paid, and more than twice as large; or no likelihood can be
/// had of them at all), it is unexplained; so it is where white noise is so many times as declared
/// as no study has it (NoisePrior::chance_of_factor() below NoiseLimits::significant_p).
/// member_gains: of the best explanation, as judge_members() gives them.
Judged judge(const search::Fitted& nominal, const search::Search& found,
             const search::Posterior& posterior, const HeldOut& held_out,
             const std::vector<double>& member_gains, NamedBy by);

}  // namespace drift::diagnosis
