#include "analysis/report/diagnosis/words/sentence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "analysis/identification/absent_channels.hpp"
#include "analysis/inference/noise/noise_component.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/words/alternative_words.hpp"
#include "analysis/report/diagnosis/words/chance_words.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/field_words.hpp"
#include "analysis/report/diagnosis/words/not_examined_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/too_large.hpp"
#include "analysis/report/diagnosis/words/verdict_openings.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "core/base/number_text.hpp"
#include "core/base/words.hpp"
#include "core/stats/normal.hpp"

namespace drift::report {
namespace {

using namespace diagnosis;

/// The shape of the strongest recovered signal, its equation said where it is not the one located;
/// a form that fits says more.
std::string located_shape_text(const Diagnosis& d) {
  if (d.proposal || d.signals.empty() || d.signals.front().shape.kind == Shape::Kind::unknown)
    return "";
  const RecoveredSignal& s = d.signals.front();
  const std::string shape = shape_text(s, d.where.recordings);
  if (s.equation == d.where.equation) return ": " + shape;
  return fmt::format(". As an input to the {}: {}", equation_in_words(s.equation), shape);
}

/// Whether a noise is nearly one constant in each of several recordings: its time constant is
/// longer than they are.
bool holds_in_each(const inference::NoiseFinding& f, const std::vector<RecordingSpan>& recordings) {
  return !recordings.empty() && std::ranges::all_of(recordings, [&](const RecordingSpan& r) {
    return f.tau_s > r.end_s - r.start_s;
  });
}

std::string noise_text(const Diagnosis& d) {
  // Of sensors on a case nobody declares it.
  const std::string_view expected = d.of_case ? "as the rows scatter" : "as declared";
  std::vector<std::string> parts;
  for (const inference::NoiseFinding& f : d.noise)
    if (f.significant && f.component != "outliers")
      parts.push_back(fmt::format(
          "{}{} ({}: {})", noise_in_words(f.component),
          holds_in_each(f, d.where.recordings) ? " that is nearly constant in each recording" : "",
          f.component,
          std::isfinite(f.factor) ? fmt::format("{:.2f} times {}", f.factor, expected)
                                  : fmt::format("{:.2g} {}", f.value, f.unit)));
  return parts.empty() ? ""
                       : fmt::format(" The noise is not {}: {}.", expected, listed(parts, "and"));
}

/// Whether the noise that was found wanders as something does that follows what is not recorded.
bool wanders(const Diagnosis& d) {
  return std::ranges::any_of(d.noise, [](const inference::NoiseFinding& f) {
    return f.significant && std::ranges::any_of(inference::beside_white, [&](const auto* c) {
             return c->name == f.component && c != &inference::caging_drift;
           });
  });
}

/// Beside a cause, where what the library does not know is more probable than not.
std::string outside_text(const Diagnosis& d) {
  const double outside = d.probabilities.outside;
  if (d.causes.empty() || outside <= inference::SearchLimits::chance) return "";
  return fmt::format(
      " Something that no term describes, in one stretch of the test perhaps, would explain it as "
      "well (probability {}).",
      decimal_text(outside, 2));
}

/// Why the only cause that was found is not named.
std::string not_confirmed_text(const Diagnosis& d, bool several) {
  if (remark_in<remark::JustSignificantLeft>(d))
    return fmt::format("with {} something is left that is just significant",
                       several ? "them" : "it");
  if (several && remark_in<remark::MemberNotConfirmed>(d))
    return "held-out data do not ask for each of them";
  if (const auto* noise = remark_in<remark::OrNoise>(d))
    return fmt::format("that nothing is missing has a probability of {}",
                       decimal_text(noise->probability, 2));
  if (const auto* other = remark_in<remark::OtherPriors>(d))
    return fmt::format("that {} has a probability of {}",
                       other_priors_text(*other, instrument_of(d)),
                       decimal_text(other->probability, 2));
  if (remark_in<remark::LambdaNotSettled>(d))
    return "its weight may still be the nominal one (3 sigma)";
  if (std::string input = input_instead_text(d); !input.empty()) return input;
  return held_out_text(d, several);
}

std::string ambiguous_text(const Diagnosis& d) {
  const std::string missing =
      fmt::format("{} (chance of a false alarm: {})", something_missing, p_text(d.p_value));
  const auto all = alternatives_of(d);
  if (all.empty())
    return fmt::format("{}, and {} cannot tell what.", missing, positions_at_hand(d));
  const std::string priors =
      priors_taken_text(d).empty() ? "" : fmt::format(" (with room in {})", priors_taken_text(d));
  if (all.size() == 1)
    return fmt::format("{}; it may be {}{}, but {}.", missing, together(d, all.front()), priors,
                       not_confirmed_text(d, all.front().size() > 1));
  std::vector<std::string> words;
  for (std::size_t k = 0; k < all.size(); ++k)
    words.push_back(fmt::format("({}) {}", k + 1, together(d, all[k])));
  return fmt::format("{}, and {} cannot tell which{}: either {}.{}", missing, positions_at_hand(d),
                     priors, fmt::join(words, ", or "), twins_text(d, all));
}

/// That no effect of the library is behind it; where one could be, how probable either is.
std::string unknown_text(const Diagnosis& d) {
  const Probabilities& p = d.probabilities;
  if (p.named.empty() || p.outside <= inference::SearchLimits::credible)
    return "no known effect explains it";
  std::vector<std::string> words;
  for (const NamedEffect& e : p.named.front().causes)
    words.push_back(fmt::format("{} ({})", in_words(e.term, e.axis, instrument_of(d)), e.label));
  return fmt::format(
      "something that no term describes{} is more probable ({}) than the likeliest known effect "
      "({}), {}",
      d.proposal ? "" : ", in one stretch of the test perhaps,", decimal_text(p.outside, 3),
      decimal_text(p.named.front().probability, 3), fmt::join(words, " together with "));
}

std::string verdict_alone(const Diagnosis& d) {
  const std::string noise = noise_text(d),
                    false_alarm = fmt::format("chance of a false alarm: {}", p_text(d.p_value));
  if (const std::string likelier = likelier_missing_text(d); !likelier.empty())
    return likelier + (noise.empty() ? "" : " Or else:" + noise);
  if (const std::string priors = wrong_priors_text(d); !priors.empty())
    return priors + beside_priors_text(d, noise);
  switch (d.verdict) {
    case Verdict::consistent:
      return fmt::format("{}{}; {}no missing physics is found (noise alone {}).{}{}", agrees,
                         but_far_from_priors(d),
                         but_far_from_priors(d).empty() ? "" : "beside that ",
                         shows_as_much(d.p_value), chance_text(d), noise);
    case Verdict::named:
      return fmt::format("{}; {} ({}).{}", lacking(d.causes, instrument_of(d)),
                         held_out_text(d, d.causes.size() > 1), false_alarm, noise);
    case Verdict::ambiguous:
      return ambiguous_text(d) + noise;
    case Verdict::unexplained:
      break;
  }
  // Noise was estimated beside what is missing; with a form in its place there may be none of it.
  return fmt::format(
      "{} ({}) and {}; it sits in the {}{}.{}", something_missing, false_alarm, unknown_text(d),
      d.where.equation.empty() ? "test as a whole" : equation_in_words(d.where.equation),
      located_shape_text(d) + misfit_text(d), d.proposal ? "" : noise);
}

std::string nearest_text(const NearestKnown& near, Instrument instrument) {
  std::vector<std::string> words;
  for (const NamedEffect& e : near.effects)
    words.push_back(fmt::format("{} ({})", in_words(e.term, e.axis, instrument), e.label));
  return fmt::format(
      " The nearest known is {}: chi-square per degree of freedom goes from {:.3g} to {:.3g}, and "
      "something significant is left.",
      fmt::join(words, " together with "), near.chi2_per_dof_before, near.chi2_per_dof_after);
}

/// What a plan has and no recording holds; with the verdict, which no short answer leaves off.
std::string absent_text(const std::vector<int>& positions) {
  if (positions.empty()) return "";
  return fmt::format("Of the plan, {} {} not recorded, what follows is of the others alone: ",
                     positions_text(positions), positions.size() > 1 ? "were" : "was");
}

/// What a recording does not hold though the study reads it.
std::string absent_text(const std::vector<std::string>& absent) {
  const bool accelerometers = identification::lacks(absent, accelerometer_channels);
  if (!accelerometers && !identification::lacks(absent, gimbal_channels)) return "";
  return fmt::format("The recording has no {}: what follows is from the {} alone. ",
                     accelerometers ? "accelerometers" : "gimbal angles",
                     accelerometers ? "gimbal angles" : "accelerometers");
}

/// What would explain the test at the declared latitude, unless the odds are against it.
std::string rival_text(const Diagnosis& d) {
  if (d.causes.empty() || d.site_doubt->clock ||
      d.site_doubt->odds > inference::RemarkLimits::decided ||
      d.causes.front().term == "latitude_error")
    return "";
  return fmt::format(" If a map confirms the latitude of [site], it is {}.",
                     together(d, alternatives_of(d).front()));
}

/// A latitude that explains what was found, and is less likely; and times that do.
std::string other_study_text(const Diagnosis& d) {
  const auto* times =
      d.verdict == Verdict::ambiguous ? nullptr : remark_in<remark::TimesInstead>(d);
  if (!d.other_latitude) return times == nullptr ? "" : " " + times_in_brief(times->clock);
  const identification::LatitudeDoubt& other = *d.other_latitude;
  if (other.clock)
    return fmt::format(
        " Times that are {:.6g} times as long would explain it, too: look at the clock of the log.",
        other.clock->factor);
  const std::string latitude =
      fmt::format(" Another latitude would explain it, too ({} instead of {:.3f} deg)",
                  latitude_text(other), other.declared / unit::deg.to_si);
  return times == nullptr ? latitude + ": check that of [site] on a map."
                          : fmt::format(
                                "{}, and so would times that are all {} times as long: check the "
                                "latitude of [site] on a map and the clock of the log.",
                                latitude, with_sigma(times->clock.factor, times->clock.sigma));
}

}  // namespace

std::string patch_text(const Diagnosis& d) {
  const auto all = alternatives_of(d);
  if (d.verdict != Verdict::ambiguous || !d.has_patch || all.empty()) return "";
  const std::string words = together(d, all.front());
  if (all.size() == 1)
    return fmt::format(
        "The patched model (patched.toml) holds the only cause that was found, {}: it is not "
        "confirmed.",
        words);
  const double probability = d.causes.front().probability;
  const std::string odds = std::isfinite(probability)
                               ? fmt::format(", probability {}", decimal_text(probability, 2))
                               : "";
  return fmt::format(
      "The patched model (patched.toml) holds alternative (1) alone, the most probable of {}{}: "
      "{}. The data do not single it out: "
      "its parameters are right only if this is the cause.",
      all.size(), odds, words);
}
std::string sentence(const Diagnosis& d) {
  if (d.heading_doubt) return heading_text(*d.heading_doubt);
  if (d.site_doubt && d.there)
    return site_and_more_text(*d.site_doubt) + " There: " + verdict_alone(*d.there);
  if (d.site_doubt && d.site_doubt->beside_causes && !d.causes.empty())
    return site_text(*d.site_doubt) +
           fmt::format(" In the model is {}, without which that latitude leaves something, too.",
                       together(d, alternatives_of(d).front()));
  if (d.site_doubt)
    return site_text(*d.site_doubt) + (d.of_case ? upside_down_text(*d.site_doubt) : "") +
           rival_text(d);
  std::string text =
      absent_text(d.absent_positions) + absent_text(d.absent) + instants_text(d) + verdict_alone(d);
  text += field_text(d);
  if (d.nearest_known && !d.proposal)  // a form that fits is nearer
    text += nearest_text(*d.nearest_known, instrument_of(d));
  if (d.verdict == Verdict::consistent)
    if (const auto* other = remark_in<remark::OtherEquation>(d); other && other->open())
      text += fmt::format(" {}.", cannot_tell_equations(*other, positions_at_hand(d)));
  text += other_study_text(d);
  text += outside_text(d);
  text += too_large_text(d);
  text += unexamined_twins_text(d.not_examined);
  if (d.verdict == Verdict::unexplained)
    text += lacking_covariate_text(d.not_examined, d.where.recordings);
  else if (d.verdict == Verdict::consistent && wanders(d))
    text += followed_text(d.not_examined, d.where.recordings);
  // Last, for a short answer leaves off what comes last: pairs of one trace are the least of it.
  if (d.verdict == Verdict::named || d.verdict == Verdict::ambiguous) text += outside_twins_text(d);
  text += errors_text(d);
  return text;
}

}  // namespace drift::report
