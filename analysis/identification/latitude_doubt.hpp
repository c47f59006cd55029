#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "analysis/identification/clock_doubt.hpp"
#include "core/recording/recording.hpp"
#include "mc/study/study.hpp"

namespace drift::identification {

/// The latitude that a recording is of, if it is not that of [site].
struct LatitudeDoubt {
  double latitude = 0.0, declared = 0.0;                       ///< [rad]
  double sigma = 0.0;                                          ///< of latitude [rad]
  double chi2_per_dof_before = 0.0, chi2_per_dof_after = 0.0;  ///< of the filter's fit
  double chance_after = 1.0;  ///< that a right model's chi-square is as far above 1 as that
  /// Log evidence for it against the declared one, where every latitude is as likely as another and
  /// noise is as the better fit has it.
  double log_evidence = 0.0;
  /// Of this latitude against the effects that would explain the test instead (site_doubt()).
  double odds = std::numeric_limits<double>::infinity();
  bool less_likely = false;  ///< than those effects, which are of sizes that their priors know
  /// It is that of the other hemisphere, by odds that no chance has (FitLimits::mirrored).
  bool mirrored = false;

  /// It leaves no more than effects that leave nothing significant, noise as it was found.
  bool as_little_left = false;
  /// It was fitted with the causes of a diagnosis in the model, without which it leaves something.
  bool beside_causes = false;

  /// The times of the recording explain as much, and better why three torquers look off alike: then
  /// the latitude of [site] stands.
  std::optional<ClockDoubt> clock = {};
  /// They explain as much, and nothing tells which of the two it is (clock_instead()).
  std::optional<ClockDoubt> or_clock = {};

  /// The latitude mends the fit by itself: what is left is no rarer than a false alarm of a
  /// diagnosis (SearchLimits::alpha), or as little as effects leave that explain all. Otherwise
  /// something else is missing, or the noise is not as declared; where much is left the latitude
  /// found is no better than the rest of the model.
  bool alone() const;

  /// The recording knows it as well as a survey does: three prior sigmas of latitude_error.
  bool as_surveyed() const;

  /// Size that latitude_error would need.
  double prior_sigmas() const;

  /// Takes the evidence where the declared latitude's chi-square is so much larger: by Laplace's
  /// method over 180 deg.
  void weigh(double chi2_above);
  /// The evidence is stronger than studies of another latitude are rare (SiteLimits::another): no
  /// latitude is doubted for what chance does; and no survey is wrong by as much.
  bool evident() const;
  /// It takes away nine tenths of what the filter leaves above its degrees of freedom.
  bool explains() const;
  /// Its latitude is nearer to the mirrored one than a tenth of the way there.
  bool is_on_other_hemisphere() const;
};

/// Where other latitudes are tried: everywhere, or only where the cost near the declared one
/// promises something.
enum class Reach { everywhere, where_it_promises };

/// Asks whether a wrong [site] latitude is behind a misfit: the filter is fitted again at other
/// latitudes (the mirrored one too), along parabolas of its cost.
///
/// Given where it is more than three prior sigmas of latitude_error off and takes away 90 % of what
/// the filter leaves above its degrees of freedom, or where it is on the other hemisphere and fits
/// far better, whatever else misfits: there isotropic D_I hide most of the error, so that the
/// priors must ask for it, too. The declared latitude is fitted from the parameters found at the
/// other as well: another valley of a parameter is no latitude. The evidence must be stronger than
/// studies of another latitude are rare (SiteLimits::another). Where the clock of the recording is
/// behind it (clock_doubt()) that is given beside it. recordings: made ready (prepare()). Empty
/// otherwise.
std::optional<LatitudeDoubt> latitude_doubt(const mc::Study& study,
                                            const std::vector<Recording>& recordings,
                                            const FilterSpec& filter,
                                            Reach reach = Reach::everywhere);

}  // namespace drift::identification
