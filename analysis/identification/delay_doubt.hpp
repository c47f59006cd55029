#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/estimate/estimate_result.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// Accelerometers and gimbals of a platform that are of different instants, by one constant time.
struct DelayDoubt {
  /// Which of the two is not of its time; the caging, which shows in the gimbals, tells.
  enum class Of { accelerometers, gimbals } of = Of::accelerometers;
  /// The other of the two, off by as much the other way, fits as well (19 to 1, RemarkLimits).
  bool either = false;
  /// By how much older than their row says its readings are; negative: later [s].
  double late = 0.0, sigma = 0.0;
  double interval = 0.0;  ///< of the rows, as they are in the file [s]
  double chi2_per_dof_before = 0.0, chi2_per_dof_after = 0.0;  ///< of the filter's fit
  double chance_after = 1.0;  ///< that a right model's chi-square is as far above 1 as that
  /// Log evidence for it against none, where every order of magnitude of a delay, from a
  /// millisecond to ten minutes and either way, is as likely as another, and noise is as the better
  /// fit has it.
  double log_evidence = -std::numeric_limits<double>::infinity();

  /// Takes the evidence where the chi-square without it is so much larger: by Laplace's method.
  void weigh(double chi2_above);
  /// The evidence is stronger than such recordings are rare: as many as those of other times
  /// (SiteLimits::another).
  bool evident() const;
  /// It takes away nine tenths of what the filter leaves above its degrees of freedom.
  bool explains() const;
  /// It leaves no more than chance does (SearchLimits::alpha).
  bool alone() const;
  /// The accelerometers are read half an interval later than the middle of their row, within what
  /// an estimate is off by (three sigma), or what a mean over a fifth of the interval is: they are
  /// momentary readings, no means.
  bool momentary() const;
};

/// A fit of a test with the readings of the accelerometers or of the gimbals so many seconds later
/// than they were read (shift_readings()). Called from several threads.
using FitAtDelay = std::function<EstimateResult(DelayDoubt::Of of, double seconds)>;

/// The delay that leaves least of a misfit, whatever else may be behind that, of the accelerometers
/// or of the gimbals: the platform turns, by the Earth's rate and its own drift, so that the two
/// show one attitude at two places of its course. By how much is read off the course itself. Three
/// fits of either, in steps of a tenth of an interval; the valley is followed only where their
/// parabola promises to take `promise` of what is above the degrees of freedom. Empty otherwise,
/// and where the cost has no valley. interval: of the rows in the file [s].
std::optional<DelayDoubt> delay_of_misfit(const FitAtDelay& at, double interval, double promise);

/// A test as it may be asked for a delay: nothing that was read in slews, where a course is none,
/// and the noise declared no smaller than what readings scatter by about their courses (those that
/// are momentary have more than means).
struct DwellsAlone {
  mc::Study study;
  std::vector<Recording> recordings;
};
/// Empty where accelerometers or gimbals were not recorded, or are not read.
std::optional<DwellsAlone> dwells_alone(const mc::Study& study,
                                        const std::vector<Recording>& recordings);

/// The same of a filter and recordings that were made ready (prepare()): the parabola must promise
/// a part of what is above the degrees of freedom (SiteLimits::promise), and the delay take nine
/// tenths of it away (SiteLimits::most), or leave what chance leaves, by evidence that is stronger
/// than such recordings are rare.
std::optional<DelayDoubt> delay_of_misfit(const DwellsAlone& test, const FilterSpec& filter,
                                          double interval);

/// [s] What is usual between the rows of recordings, as they were read; 0 if nothing is.
double usual_interval(const std::vector<Recording>& recorded);

}  // namespace drift::identification
