#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/estimate/estimate_result.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// The times of a recording that are all too long, or too short: a sample interval that is not what
/// was written down, or another clock than that of the commands.
struct ClockDoubt {
  double factor = 1.0, sigma = 0.0;                            ///< true times over recorded ones
  double chi2_per_dof_before = 0.0, chi2_per_dof_after = 0.0;  ///< of the fit at [site]
  /// Log evidence for it against the recorded times, where every factor from a half to twice is as
  /// likely as another (by its logarithm) and noise is as the better fit has it; of
  /// clock_of_misfit().
  double log_evidence = -std::numeric_limits<double>::infinity();

  /// Takes the evidence where the recorded times' chi-square is so much larger: by Laplace's
  /// method.
  void weigh(double chi2_above);
  /// The evidence is stronger than recordings with such times are rare, which are taken to be as
  /// many as those of another latitude (SiteLimits::another).
  bool evident() const;
};

/// Asks whether the clock is behind what looks like another latitude. With times too long by a part
/// in a hundred the three torquers look as much too weak, all alike, and the Earth turns as much
/// too slowly: near the meridian that is another latitude. Given where the three scale factors
/// fitted at that latitude are common beyond their priors (common_scale()), and the study's own
/// latitude with other times fits as well or leaves what chance leaves (SearchLimits::alpha).
/// recordings: made ready (prepare()). Empty otherwise.
std::optional<ClockDoubt> clock_doubt(const mc::Study& study,
                                      const std::vector<Recording>& recordings,
                                      const FilterSpec& filter, double other_latitude);

/// Whether the clock may stand in place of another latitude (sigma: of that one [rad]). Without
/// commanded turns the times scale the Earth's rate alone; what that does about Up isotropic D_I
/// take up, and what it does about North is another latitude. Given where the evidence against it
/// is no stronger than a false alarm of a diagnosis is rare (SearchLimits::alpha). Empty otherwise.
std::optional<ClockDoubt> clock_instead(const mc::Study& study,
                                        const std::vector<Recording>& recordings,
                                        const FilterSpec& filter, double other_latitude,
                                        double sigma);

/// A fit of a test with all its times `factor` times as long; its sigmas are not asked for. Called
/// from several threads.
using FitAtTimes = std::function<EstimateResult(double factor)>;

/// The clock that leaves least of a misfit, whatever else may be behind that. Three fits, at the
/// recorded times and a ten-thousandth to either side; the valley is followed only where their
/// parabola promises to take `promised` off chi-square. Empty otherwise, and where the cost has no
/// valley.
std::optional<ClockDoubt> clock_of_misfit(const FitAtTimes& at, double promised);
/// The same of a filter and recordings that were made ready.
std::optional<ClockDoubt> clock_of_misfit(const mc::Study& study,
                                          const std::vector<Recording>& recordings,
                                          const FilterSpec& filter, double promised);

}  // namespace drift::identification
