#pragma once

/// Every number that decides what a user is told of a fit as such, of its parameters, and of the
/// study that it was made with. How they are written, and all others: thresholds.hpp.
namespace drift::inference {

/// What is said of a fit as such.
struct FitLimits {
  /// [sigma] of chi-square over its degrees of freedom beyond which a fit is a misfit, and below
  /// which it has less noise than declared: 6e-7 of the right models, both sides. Tests:
  /// FitWords.TheWordOfAFit..., FitWords.AFitWithLessNoise...
  static constexpr double misfit = 5.0;
  /// [prior sigma] from a prior's mean, two-sided: 6e-7 for each parameter that is of its prior,
  /// 1e-4 for any of 200. An effect beyond it is also fitted as it is found (size_prior.hpp).
  /// Tests: FitWords.ParametersFarFromTheirPriors..., Thresholds.ParametersFiveSigma...,
  /// SizePrior.FarBeyond...
  static constexpr double beyond_prior = 5.0;
  /// Chance that the farthest of all parameters of right priors lies so far from its mean, below
  /// which a fit has to be examined by a diagnosis: one right study in 20, as beyond the band of
  /// its chi-square. Test: FitWords.AParameterFarFromItsPrior...
  static constexpr double far_from_prior = 0.05;
  /// [2 log L, scaled to a chi-square of 1 per degree of freedom] by which the mirrored latitude
  /// must fit better to be the right one where something else misfits too: odds of e^20 against a
  /// wrong hemisphere in one study of 1000 leave 2e-6. Test: LatitudeDoubt.TheWrongHemisphere...
  static constexpr double mirrored = 40.0;
  /// Chance of scale factors that differ so much by their priors, below which what moved them is
  /// not one cause. Test: CommonScale.*
  static constexpr double unlike_scales = 1e-3;
  /// Times the sigma of one estimator, by which that of the other differs although both were given
  /// the same: with a linear model they would be one. Tuned: linearisation, no noise.
  static constexpr double unlike_sigmas = 3.0;
};

/// What an estimate of a parameter is worth, by `identify`.
struct WorthLimits {
  /// Posterior over prior sigma above which nothing was learned, 64 % of the prior's variance is
  /// left; and up to which a parameter is known by itself, a quarter of it is. By convention.
  /// Test: ParameterVerdict.IsThePriorWhere...
  static constexpr double nothing_learned = 0.8, half_learned = 0.5;
  /// Part of its variance that is the prior's, above which it is known in a sum alone: most of it.
  /// Test: ParameterVerdict.IsInASumAlone...
  static constexpr double mostly = 0.5;
  /// [sigma] off the truth, where that is known: 6e-7 of the right models for each parameter, 6e-5
  /// for any of 100. Test: ParameterVerdict.IsWrongBeyond...
  static constexpr double surely_wrong = 5.0;
  /// |correlation| above which a parameter alone is known much worse than a sum: where the other is
  /// known, 19 % of its variance is left.
  static constexpr double tied = 0.9;
};

/// When the latitude of the study is doubted.
struct SiteLimits {
  /// Studies that say another latitude than the recording's, as of headings, and recordings whose
  /// times are all too long or too short, and priors that are wrong: one of 1000. Test:
  /// ClockDoubt.IsEvidentWhere..., WrongPrior.IsARival...
  static constexpr double another = 1e-3;
  /// Headings that the positions of a caging may have had instead of the plan's, by 45 deg each and
  /// each as probable: 7 of them. Test: HeadingDoubt.*
  static constexpr double other_headings = 7.0;
  /// [deg] prior of the rest that a latitude is still off when it was found without effects that
  /// are there: wide against what they bend it by, within reach of a linear model.
  static constexpr double bent_deg = 1.0;
  static constexpr double survey = 3.0;  ///< [prior sigma of latitude_error] no survey is wrong by
  static constexpr double most = 0.9;    ///< part of the misfit that another latitude takes away
  /// Part of the strongest score that latitude_error, or what follows an assumed field, has, and
  /// part of the misfit that the foot of the parabola promises, for latitudes to be tried. Tuned on
  /// time.
  static constexpr double worth_asking = 0.5, promise = 0.5;
};

}  // namespace drift::inference
