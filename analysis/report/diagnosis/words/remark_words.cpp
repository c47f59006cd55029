#include "analysis/report/diagnosis/words/remark_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "analysis/diagnosis/findings/fit_comparison.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/delay_words.hpp"
#include "analysis/report/identify/loop_words.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"
#include "core/physics/closure.hpp"

namespace drift::report {
namespace {

using namespace diagnosis::remark;

auto other_number(const OtherEquation& r) {
  return facts(*facts(r.nominal).other).number;
}

/// How an equation that is not ruled out compares: "the test is explained as well", or "the odds
/// are 33 to 1 for the nominal one, less than 3 sigma" (RemarkLimits::equation).
std::string as_well_text(double gain) {
  const std::string number = fmt::format("twice the log of the odds: {:+.1f}", gain);
  if (std::abs(gain) <= inference::RemarkLimits::as_well)
    return fmt::format("the test is explained as well ({})", number);
  return fmt::format("the odds are {} to 1 for the {} one, less than 3 sigma ({})",
                     number_text(std::exp(0.5 * std::abs(gain)), 2),
                     gain < 0.0 ? "nominal" : "other", number);
}

/// One overload for each kind of remark.
struct Words {
  Instrument instrument;
  RecordingNames recordings;

  std::string operator()(const Input& r) const { return r.text; }

  std::string operator()(const GimbalOffZero& r) const { return r.text; }
  std::string operator()(const SaturatedGyro& r) const { return r.text; }

  std::string operator()(const LoopLeftOut& r) const {
    return loop_left_out_text(r.loop, recordings, {r.filter});
  }

  std::string operator()(const OrNoise& r) const {
    return fmt::format(
        "That nothing is missing, by chance or by noise that is not as declared, has a probability "
        "of {:.2g}: a repeated recording tells an effect, which comes again, from noise, which "
        "does "
        "not.",
        r.probability);
  }

  std::string operator()(const LikelierMissing& r) const {
    return fmt::format(
        "Nothing is significant, and still that nothing is missing, noise as declared or not, has "
        "a "
        "probability of {:.2g} only: effects are listed by their probability, and none is named. A "
        "repeated recording tells an effect, which comes again, from noise, which does not.",
        r.nothing);
  }

  std::string operator()(const JustSignificantLeft&) const {
    return "With it in the model something is left that is just significant: chance, or not the "
           "whole story. It is listed, not named.";
  }

  std::string operator()(const LambdaNotSettled&) const {
    return "Another drift equation explains it, but its weight lambda may still be the nominal one "
           "(3 sigma): it is listed, not named.";
  }

  std::string operator()(const MemberNotConfirmed&) const {
    return "The causes fit together, but without one of them held-out positions are predicted no "
           "worse: it is not confirmed (held_out_gain of each cause in diagnosis.json).";
  }

  std::string operator()(const NotPredicted& r) const {
    if (r.of_recordings)
      return "The cause fits, and held-out positions are predicted better with it, but whole "
             "recordings are not, each from a fit to the others: what it stands for may be in one "
             "recording only. Diagnose each recording alone.";
    return "The cause fits, but held-out positions are not predicted better with it. An effect "
           "that lives in one position cannot be confirmed by the others: repeat that position.";
  }

  std::string operator()(const LeftNotWhite& r) const {
    return fmt::format(
        "With the cause in the model the innovations are less white than chance makes them in 19 "
        "of "
        "20 recordings (p {}, without it {}): {}.",
        p_text(r.after), p_text(r.before),
        r.before < inference::RemarkLimits::whiteness_p
            ? "something beside it is left"
            : "something is left, or the cause takes the place of another");
  }

  std::string operator()(const SamplesLeftOut& r) const {
    return fmt::format(
        "{} isolated sample{} {} left out{} and {} given less weight: their residuals are larger "
        "than Gaussian noise gives.",
        r.removed.size(), plural(r.removed.size()), r.removed.size() == 1 ? "was" : "were",
        spikes_text(r.removed, recordings), r.lowered);
  }

  std::string operator()(const FreeInputExplains& r) const {
    return fmt::format(
        "{} in {} alone{} would explain it (twice the log likelihood better by {:.1f}).",
        r.constant ? "An unknown constant" : "An unknown input of free form", r.equation,
        r.constant ? ", another one in each recording," : "", r.gain);
  }

  std::string operator()(const PeriodExplains& r) const {
    if (r.beside_cause)
      return fmt::format(
          "Beside it a sinusoid in {} is left, with a period of {:.4g} min and an amplitude of "
          "{:.3g} "
          "{} (noise shows one as strong, whatever its period, with a chance of {}).",
          r.equation, r.period_s / 60.0, r.amplitude, r.unit, p_text(r.p_value));
    return fmt::format(
        "A sinusoid in {} alone, with a period of {:.4g} min and an amplitude of {:.3g} {}, would "
        "explain it or most of it (noise shows one as strong, whatever its period, with a chance "
        "of {}).",
        r.equation, r.period_s / 60.0, r.amplitude, r.unit, p_text(r.p_value));
  }

  std::string operator()(const CrosstalkMovesLambda&) const {
    return "Cross-talk between the torquing channels (taken as zero) moves lambda (frame_closure) "
           "as much as misalignment does in slews; only Earth rate and turns of the case tell them "
           "apart.";
  }

  std::string operator()(const DrivesOneGyro& r) const {
    return fmt::format(
        "What drives the platform acts on gyro {} alone: it is no noise that the gyros share "
        "(twice the log likelihood better by {:.1f}).",
        "xyz"[r.axis], r.gain);
  }

  std::string operator()(const IncredibleNoise& r) const {
    return fmt::format(
        "White noise of the {} {:.3g} times as declared is no noise that a study is wrong by "
        "(chance "
        "{}): the rows, their unit, or the noise that [readout] declares must be wrong.",
        r.component == "gimbal_white" ? "gimbals" : "accelerometers", r.factor, p_text(r.chance));
  }

  std::string operator()(const StrongestLeft& r) const {
    return fmt::format(
        "With {} in the model the strongest of what is left is {}: {} and diagnose again",
        fmt::join(r.labels, " and "), r.strongest,
        !r.labels.empty() && r.labels.front() == closure_term
            ? "take the other equation"
            : "put the first into the nominal filter");
  }

  std::string operator()(const BeyondPrior& r) const {
    return beyond_prior_text(r) +
           ". If that is not this unit, the study is not of this recording: check [site] "
           "latitude, " +
           (instrument == Instrument::on_case ? "the axes of the sensors"
                                              : "axes and commands of the plan") +
           ", and the priors";
  }

  std::string operator()(const OtherPriors& r) const {
    return fmt::format("Or else {} (probability {})", other_priors_text(r, instrument),
                       decimal_text(r.probability, 2));
  }

  std::string operator()(const OtherEquation& r) const {
    const std::string with = r.beside_cause ? ", the cause in the model" : "";
    if (!r.open())
      return fmt::format(
          "The recording speaks for the nominal eq. ({}): fitted with eq. ({}) instead{}, twice "
          "the log of the odds changes by {:+.1f}",
          facts(r.nominal).number, other_number(r), with, r.gain);
    constexpr std::string_view
        on_a_case = "Turns about each axis of the case tell them apart",
        on_a_platform =
            "What tells lambda from the misalignments: slews about each platform axis, free "
            "drift beside level positions, or turns of the case. In slews, cross-talk between the "
            "torquing channels (torquer_crosstalk) looks like lambda";
    return fmt::format("{}: fitted with the other{}, {}. {}", cannot_tell_equations(r, "this plan"),
                       with, as_well_text(r.gain), r.of_case ? on_a_case : on_a_platform);
  }

  std::string operator()(const MemoryOff& r) const {
    return memory_sentences(r.terms, r.gaps, recordings);
  }

  std::string operator()(const DelayInstead& r) const { return delay_text(r.delay); }

  std::string operator()(const TimesInstead& r) const { return times_instead_text(r.clock); }

  std::string operator()(const FieldAssumed& r) const { return field_assumed_text(r.field_l); }

  std::string operator()(const NoiseOrEffect& r) const {
    return fmt::format(
        "Without the noise that was found to drive the platform, {} would explain the test ({:.1f} "
        "sigma): a slow effect and such noise look alike here. More positions or longer dwells "
        "tell them apart",
        in_words(r.effect.term, r.effect.axis, instrument), r.sigmas);
  }

  std::string operator()(const NoAdvice& r) const {
    return fmt::format("No advice could be made: {}", r.reason);
  }

  std::string operator()(const NoDeclaredNoise&) const {
    return "a recording on a case declares no noise: what is called declared is the scatter within "
           "its dwells";
  }

  std::string operator()(const CommonDriftUnseen&) const {
    return "D_I_x, D_I_y and D_I_z are less their mean: their common part is not observable";
  }

  std::string operator()(const NotObservable& r) const {
    return fmt::format("not observable: {}: {}", r.what, r.reason);
  }
};

}  // namespace

std::string in_words(const diagnosis::Remark& remark, Instrument instrument,
                     const std::vector<diagnosis::RecordingSpan>& recordings) {
  return std::visit(Words{instrument, names_of_recordings(recordings)}, remark);
}

std::string cannot_tell_equations(const OtherEquation& open, std::string_view positions) {
  std::string who(positions);
  who.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(who.front())));
  return fmt::format("{} cannot tell the nominal eq. ({}) from eq. ({})", who,
                     facts(open.nominal).number, other_number(open));
}

}  // namespace drift::report
