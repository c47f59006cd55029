#pragma once

/// Every number that decides what a user is told of an identification. How to read them:
/// analysis/inference/thresholds.hpp.
namespace drift::identification {

struct FitLimits {
  /// [sigma] of chi-square over its degrees of freedom beyond which a fit is a misfit: 6e-7 of the
  /// right models, both sides. Test: FitWords.TheWordOfAFit...
  static constexpr double misfit = 5.0;
  /// [prior sigma] from a prior's mean, two-sided: 6e-7 for each parameter that is of its prior,
  /// 1e-4 for any of 200. Test: FitWords.ParametersFarFromTheirPriors...
  static constexpr double beyond_prior = 5.0;
  /// [2 log L, scaled to a chi-square of 1 per degree of freedom] by which the mirrored latitude
  /// must fit better to be the right one where something else misfits too: odds of e^20 against a
  /// wrong hemisphere in one study of 1000 leave 2e-6. Test: LatitudeDoubt.TheWrongHemisphere...
  static constexpr double mirrored = 40.0;
};

}  // namespace drift::identification
