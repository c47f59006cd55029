#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "analysis/inference/fit_thresholds.hpp"

/// Every number that decides what a user is told of a recording, by `diagnose` and by `identify`:
/// here those of causes and noise, in fit_thresholds.hpp those of a fit as such. Those by which
/// recording and plan are looked over are in analysis/preparation/input_thresholds.hpp, whether
/// starts agree is said by core/estimate/start_consistency.hpp, and what is said of gyros on a case
/// alone stands in analysis/strapdown.
///
/// Each says what it means, in which unit, and the probability or derivation it stands for; where
/// there is none it says "tuned". Grids, steps and counts of iterations stay beside the algorithms
/// that use them. "Test:" names what meets a number from both sides and fails if it is moved; the
/// diagnoses of tests/reference watch them all, those without a test alone.
///
/// Units: [2 log L] twice a log likelihood or evidence; [log] a log evidence or log chance;
/// [strength] minus the log of the tail of a chi-square; [sigma] standard deviations.
namespace drift::inference {

/// When two effects leave the same trace. unlike = 1 - cosine^2 of their projected signatures is
/// the part of one that the other cannot copy: of an effect of A sigma, A sqrt(unlike) sigma are
/// left to tell the two by.
struct TraceLimits {
  /// Below: the same. An effect would have to be 63 sigma strong to be told from its twin by 2.
  /// Test: Thresholds.TracesAreTheSame..., Sentence.OfTwins..., BlindScore.ATwinCounts...
  static constexpr double unlike = 1e-3;
  /// Below, over a whole pool of possible positions: the same however strong (2000 sigma for 2).
  static constexpr double unlike_anywhere = 1e-6;
  /// [sigma] by which a form must be told from a parameter of the library, or it is that parameter:
  /// the best of some 400 on one axis by chance, once in 50 (SearchLimits::alpha).
  /// Test: FarBeyondPrior.IsNamedWithItsSize.
  static constexpr double form_told_by = 4.0;
  /// |cosine| above which a cause is listed as confusable, and how many are. Tuned: a short list.
  static constexpr double confusable = 0.5;
  static constexpr std::size_t most_confusable = 5;
};

/// The definition of "they leave the same trace on this plan", by the part that is unlike.
constexpr bool same_trace_of_unlike(double unlike) {
  return unlike < TraceLimits::unlike;
}
/// The same, by the cosine of the projected signatures.
constexpr bool same_trace(double cosine) {
  return same_trace_of_unlike(1.0 - cosine * cosine);
}

/// What can be seen at all.
struct VisibleLimits {
  /// Information [per prior sigma squared] that makes a column observable: below it the effect
  /// would have to be some forty prior sigmas large to be found (4 sigma).
  /// Test: Thresholds.AColumnIsSeen...
  static constexpr double information = 1e-2;
  /// The part of that which must be left beside causes that are in the model. Test: as `left`.
  static constexpr double information_beside = 0.1;
  /// Part of its own information that a column must keep beside causes, or a window beside the
  /// parameters, to count as another effect; of several columns and of windows beside causes by
  /// eigenvalue. Above the rounding of the projections (1e-9), below what 2000 sigma could show.
  /// Test: Remainder.WhatIsLeftOfATwinIsNoOtherEffect
  static constexpr double left = 1e-6, left_of_several = 1e-5;
  /// [sigma] that an effect of a usual size must be strong for a test to count as one that could
  /// have seen it. Where probabilities say "nothing missing", it means nothing of such a size.
  static constexpr double size = 3.0;
};

/// What follows the temperature beyond the first order, or the scale factor that follows it.
struct TemperatureLimits {
  /// [degC] from the lowest to the highest temperature of a test, below which it is not looked for.
  /// At their priors the second order is dT / (30 degC) of the first: over 3 degC a twentieth, so
  /// that an effect of first order of 20 sigma would have one of 1 sigma beside it. A laboratory
  /// with a thermostat stays below. Test: CaseTemperature.OneThatHardlyMoves...
  static constexpr double swing = 3.0;
};

/// Samples that are none, and a misfit that no noise gives.
struct SampleLimits {
  /// [sigma, the larger of declared and found] from the median of four neighbours: 7 of its own
  /// sigma (1.14). Normal noise has one so far away in 4e11 samples, any in a test of 4e7 samples
  /// with a chance of 1e-4. On top of it so many ranges of the neighbours: a motion that only rises
  /// or falls over the five, or turns once, takes the middle one at most 1.5 ranges away, and two
  /// ranges of the three neighbours without the farthest (dwells): p, 2p, q, 2q above the lowest,
  /// with q = 2p. Test: Thresholds.ASpikeIs..., IsolatedSamples.TwoBesideEachOther...
  static constexpr double spike = 8.0, spike_spread = 2.0;
  /// Chi-square per row, under the noise of neighbours' differences, from which noise that drives
  /// the platform is believed only if it is of a usual size (NoisePrior::usual): a long test with a
  /// random walk of such a size has more. Test: Thresholds.AMisfitOfThirty...
  static constexpr double gross = 30.0;
  /// Outliers are at most so large a part of the samples; more of them, and the model is wrong.
  static constexpr double outlier_most = 0.02;
  /// Positions of which only the last row stands out, from which their numbers are late: of dwells
  /// of n rows stray samples do so with a chance of 1/n^3, 5e-6 for an hour of minutes.
  /// Test: LateLabels.*
  static constexpr std::size_t late_positions = 3;
  /// Robust sigma, of declared, that is more than its scatter. Test: Thresholds.NoiseMoreThan...
  static constexpr double spread = 1.1;
};

/// Which noise is said to be there.
struct NoiseLimits {
  static constexpr double component = 2.7;   ///< [2 log L] to come in: 5 %, half chi-square of 1
  static constexpr int most_components = 4;  ///< beside white noise and what is declared
  /// Chance below which it is not as declared. Test: Thresholds.NoiseIsSaid...
  static constexpr double significant_p = 1e-3;
  /// Components times time constants that are tried at once, at most: two random walks, two Markov
  /// processes of two time constants each, a drift of each caging. Bounds the chance that the best
  /// of them is chance; a gain of 13.2 has one of 1e-3. Test:
  /// Noise.AngleRandomWalkIsFoundWithItsSize
  static constexpr double alternatives = 7.0;
  /// [2 log L] by which noise of one gyro alone beats that of all three; the best of three axes and
  /// four sizes does so by chance 12 exp(-5) = 0.08 times at most.
  static constexpr double one_gyro = 10.0, one_gyro_tries = 12.0;
  /// Chi-square per degree that is an evident misfit, and the part of its excess that the other
  /// equation must take away for it not to be asked for noise. Tuned on wrong equations.
  static constexpr double evident = 1.5, other_equation = 0.8;
  /// Chi-square per row of noise twice as large as was found, where some of it is known beforehand
  /// (rounding) and not estimated; and the [log] odds, 10^6 to 1, at which one more factor of noise
  /// is taken for none.
  static constexpr double far_off = 4.0, far_likelier = 13.8;
};

/// The prior over noise, stated in diagnose.md; not tuned. Test: NoisePrior.SumsToOne.
struct NoisePrior {
  static constexpr double as_declared = 0.8;  ///< whatever drives the mean
  /// Otherwise white noise is of unknown size and each set of what may drive the platform (two
  /// random walks, two Markov processes, a drift of each caging) is as probable as any other.
  static constexpr double sets = 32.0;
  static double log_not_as_declared() { return std::log((1.0 - as_declared) / sets); }
  /// Bias instability of gyros over their angle random walk [1/sqrt(h)], as data sheets of 0.001 to
  /// 0.5 deg/sqrt(h) have it, one sigma to either side. Test: UsualSize.IsThatOfTheGrade...
  static constexpr double least_instability = 5.0, most_instability = 60.0;
  /// Log density of a size, z sigmas from the middle of its usual range: Student's t of three
  /// degrees, as better and worse instruments than the usual ones exist.
  static double log_density(double z) {
    constexpr double at_zero = 0.3675525969478614;  // 2 / (pi sqrt(3))
    return std::log(at_zero) - 2.0 * std::log1p(z * z / 3.0);
  }
  /// The chance that noise is not as declared and, of white noise declared within a factor of two,
  /// so many times as much or more, or as much less: both tails of that t.
  static double chance_of_factor(double factor) {
    const double z = std::abs(std::log2(factor)) / std::sqrt(3.0);
    const double beyond = 1.0 - 2.0 / std::numbers::pi * (std::atan(z) + z / (1.0 + z * z));
    return (1.0 - as_declared) * beyond;
  }
  /// [z] Of 40 instruments one has more: its 97.5 % point. Test: Thresholds.DrivingNoiseIs...
  static constexpr double usual = 3.182446305284263;
};

/// How sure a diagnosis is.
struct SearchLimits {
  static constexpr double alpha = 0.02;  ///< chance of a false alarm over all that is tried
  /// Probability of nothing missing above which what is significant is taken for chance, and of
  /// something missing above which what is not significant is not taken for nothing, and of
  /// something outside the library above which it is said beside a cause: more probable than not.
  /// Test: Thresholds.WhatIsMoreProbablyChance..., Judge.WhatIsMoreProbablyMissing...
  static constexpr double chance = 0.5;
  /// That what is listed must hold together. Test: CredibleSet.ListsWhat...
  static constexpr double credible = 0.95;
  /// How the chance is shared between candidates, windows, pairs, inputs of free form and periodic
  /// ones in one equation: they sum to 1. Tuned: half to what can be named.
  /// Test: ChanceThresholds.AreExceeded...
  static constexpr double library_share = 0.5, scan_share = 0.15, pair_share = 0.15,
                          lone_share = 0.1, periodic_share = 0.1;
  /// The windows' share is cut by this where they rule out a cause: thousands are looked at.
  static constexpr double scan_cut = 3.0;
};

/// Which explanations are tried; [log] behind the best unless said otherwise.
struct ReachLimits {
  static constexpr double negligible = 14.0;      ///< one in a million
  static constexpr double worth_refining = 25.0;  ///< one in 7e10; a partner may lift it
  /// Pairs by unit priors: one in a million, and e^8 for sizes that such priors misjudge.
  static constexpr double pair = 22.0;
  /// Another setting of a candidate, far from its best: for the refit (one in 55), and for a finer
  /// grid, where it may come to be the best (one in 400).
  static constexpr double refit_setting = 4.0, refine_setting = 6.0;
  static constexpr double part = 3.0;  ///< a part of a wider candidate replaces it: one in 20
  /// Effects beyond linearisation are tried unless the other equation leaves them so many times
  /// `negligible` behind. Tuned.
  static constexpr double large = 10.0;
  /// Times a threshold, within which linear scores leave the decision to the refit: of single
  /// candidates, of pairs. Tuned.
  static constexpr double slack = 1.25, pair_slack = 1.1;
};

/// How much is tried. More costs time and could find another name; tuned on time.
struct EffortLimits {
  static constexpr std::size_t refits = 6;         ///< single candidates, and pairs
  static constexpr std::size_t settings = 2;       ///< of one candidate
  static constexpr std::size_t large = 2;          ///< candidates where none is adequate
  static constexpr std::size_t beside_asked = 12;  ///< candidates asked beside another equation,
  static constexpr std::size_t beside = 3;         ///< and pairs with it that are refitted
  static constexpr std::size_t wide_in_pairs = 12, widest_in_pairs = 6;  ///< candidates, parameters
  static constexpr int pairs_of_a_name = 2;
  static constexpr std::size_t together = 4;  ///< causes found one after the other
  /// Candidates tried at each step in the place of noise; beside a cause.
  static constexpr std::size_t noise_tries = 4, noise_tries_beside = 2;
  static constexpr std::size_t noises = 2;  ///< estimated of these at least
  /// Iterations of a fit at a latitude that is tried blindly: at the recording's own it ends after
  /// 5 to 10, elsewhere it often never does.
  static constexpr int blindly = 15;
  /// [rad] by which the platform and its gyros may have turned between two fits for a candidate's
  /// columns of one to be taken for those of the other: they are off by that part of themselves.
  /// Test: Signatures.OfAFitNearby...
  static constexpr double turned = 1e-3;
};

/// Which explanation is kept, and named.
struct WeighLimits {
  static constexpr double quiet_p = 0.01;  ///< of a free input beside a cause: something is left
  /// [log] of a chance, by which what is left may exceed its threshold: one in 20 of what that lets
  /// by. Test: CredibleSet.WhatLeavesFarTooMuch...
  static constexpr double tolerable = 3.0;
  static constexpr double needed = 3.0;        ///< [sigma] from zero, of each of several causes
  static constexpr double other_lambda = 3.0;  ///< [sigma] from the nominal equation's, to be named
  static constexpr double sign = 2.0;  ///< [sigma] expected, if another sign is to count against
  /// [2 log L] that an end of lambda gains on the joint fit: this lies outside the 95 % interval.
  /// Test: ClosureProfile.*
  static constexpr double valley = 3.841458820694124;
  /// Odds against something outside the library beside a cause. Of causes of the library:
  /// library_prior.hpp.
  static constexpr double outside_too = 20.0;
  /// [log] that more parameters must bring: 20:1. Test: CredibleSet.MoreParametersMustBring...
  static constexpr double more_parameters = 3.0;
  /// Forms of an unknown input: 7 kinds on 3 axes (of one instrument alone 5: then it is too dear;
  /// of several recordings 10: e^0.4 too cheap). Test: as `far_better`.
  static constexpr double forms = 21.0;
  /// [log] by which an unknown input leaves a cause behind: 150:1; and the part of the cause's own
  /// evidence that linearisation may be wrong by; tuned. Test: CredibleSet.SomethingUnknown...
  static constexpr double far_better = 5.0, not_linear = 0.05;
  /// [log score] that held-out positions must gain: e:1. Test: Thresholds.EachOfSeveralCauses...
  static constexpr double held_out = 1.0;
  /// [sigma] of the library's prior beyond which a found size widens it in patched.toml.
  /// Test: Thresholds.ASizeBeyondThreeSigma...
  static constexpr double prior = 3.0;
};

/// The prior over what a recording may be, as stated in diagnose.md; not tuned. Test:
/// Posterior.IsThePriorWhereAllExplainTheDataAlike, and the reliability table of blind studies.
struct PosteriorPrior {
  /// Nothing beside the nominal model, one term of the library or several, something outside it.
  static constexpr double nothing = 0.5, library = 0.45, outside = 0.05;
  static_assert(nothing + library + outside == 1.0);
  static constexpr double listed = 1e-3;  ///< probability below which none is listed
};

/// What is said beside the verdict.
struct RemarkLimits {
  /// [2 log L] that rules out eq. (5) or (6): 90:1. Test: Thresholds.AnEquationIsOpen...
  static constexpr double equation = 9.0;
  static constexpr double detectable = 0.84;  ///< [sigma] above a threshold: found 4 times of 5
  static constexpr double outliers_p = 1e-4;  ///< said of outliers: 4 sigma of their number
  static constexpr double lone_p = 0.01;      ///< of an unknown input that would explain it
  /// Of the whiteness of innovations: of a right model they have more in 19 of 20 recordings.
  static constexpr double whiteness_p = 0.05;
  /// Odds to 1 at which one of two explanations is far likelier: a probability of 0.95.
  static constexpr double decided = 19.0;
  /// [2 log L] up to which an equation explains a test as well as the other: odds of e to 1, not
  /// worth a mention.
  static constexpr double as_well = 2.0;
  /// Family-wise p above which a candidate is no stronger than chance: one recording in 20 of right
  /// models has one that is called stronger.
  static constexpr double chance_p = 0.05;
  /// [prior sigma] above which a candidate that its size alone makes less likely is named all the
  /// same: 1 in 400 units has it.
  static constexpr double large_size = 3.0;
  /// Part of the misfit that a rejected cause explains. Test: Thresholds.TheNearestKnown...
  static constexpr double nearest = 0.05;
  /// [2 log L] of an effect that noise may stand for, 5 sigma; per further amplitude.
  static constexpr double or_effect = 25.0, or_effect_per_amplitude = 3.0;
  /// Part of a memory (MemoryLeftOut, MemoryOverGap) that is wrong: an amplitude that multiplies it
  /// is off by as much of itself, at most (Cauchy and Schwarz). Test: MemoryDoubt.*, MemoryGaps.*
  static constexpr double memory = 0.1;
  static constexpr double shape = 0.3;  ///< |correlation| below which a shape says nothing. Tuned
};

/// What is advised.
struct AdviceLimits {
  static constexpr double told = 2.0;  ///< [sigma] below which nobody would decide
  /// [sigma] that is found almost surely. Test: ChooseAdditions.EightSigmaAreEnough
  static constexpr double wanted = 8.0;
  static constexpr std::size_t most = 3;      ///< additions to a plan
  static constexpr double least_gain = 1e-3;  ///< of the mean way to `wanted`
  /// A margin is taken that sets the closest pair so many times farther apart in no more than so
  /// many times the hours. Tuned. Test: ChooseAdditions.AMarginIsTwiceAsFar...
  static constexpr double margin = 2.0, margin_hours = 2.0;
};

}  // namespace drift::inference
