#include <algorithm>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/report/diagnosis/sections.hpp"
#include "analysis/report/diagnosis/words/advice_words.hpp"
#include "analysis/report/diagnosis/words/doubts.hpp"
#include "analysis/report/diagnosis/words/form_words.hpp"
#include "analysis/report/diagnosis/words/not_examined_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/sentence.hpp"
#include "analysis/report/diagnosis/words/too_large.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/delay_words.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/loop_words.hpp"
#include "analysis/report/identify/turned_words.hpp"
#include "analysis/report/page/study_words.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/words.hpp"
#include "core/physics/closure.hpp"
#include "core/physics/parameters_config.hpp"

namespace drift::report {

using namespace diagnosis;

namespace {

/// Whether the latitude is all that is wrong.
bool nothing_else(const identification::LatitudeDoubt& doubt) {
  return doubt.alone() && !doubt.beside_causes;
}

/// What is left beside the effects that come nearest, if anything is.
std::optional<remark::StrongestLeft> strongest_left(const Diagnosis& d) {
  for (const Remark& r : d.remarks)
    if (const auto* left = std::get_if<remark::StrongestLeft>(&r); left && !left->labels.empty())
      return *left;
  return std::nullopt;
}

/// A key of the nominal model, which is the first filter, as --set takes it.
std::string key_of_nominal(const FilterSpec& nominal, std::string_view key) {
  return key_of_filter(nominal, 0, key);
}

/// The parameters that a candidate's line names: "accelerometer K0" those of K0.
ParamMask named_by(std::string_view label) {
  ParamMask all;
  for (std::size_t end = label.find(' '); end != label.npos; end = label.find(' ')) {
    label.remove_prefix(end + 1);
    all |= params_named(label.substr(0, label.find(' ')));
  }
  return all.any() ? all : params_named(label);
}

/// How the nominal model gets an effect, with the key that does it where one does. A list of terms
/// that may be there by default is none that could be added to.
std::string diagnosed_with(const FilterSpec& nominal, std::string_view label) {
  const std::string term(label.substr(0, label.find(' ')));
  const auto other = facts(nominal.coupling).other;
  if (term == closure_term && other)
    return fmt::format("Diagnose again under the other equation: --set \"{}={}\".",
                       key_of_nominal(nominal, "coupling"), key_of(*other));
  if ((named_by(label) & ~nominal.active).none())
    return fmt::format("Give the first, {}, a prior in [filter.parameters] and diagnose again.",
                       label);
  ParamMask listed = nominal.active;
  listed.reset(closure_param);  // of the coupling
  const std::string added =
      listed == base_parameters()
          ? shell_word(fmt::format(
                "{}=[\"{}\"]", key_of_nominal(nominal, "terms"),
                fmt::join(terms_text(nominal.active | TermLibrary::completed(params_named(term))),
                          "\", \"")))
          : fmt::format("\"{}+={}\"", key_of_nominal(nominal, "terms"), term);
  return fmt::format("Diagnose again with the first in the model: --set {}.", added);
}

/// Whether the plan tells already what was asked: that leaves the next step to others.
bool asks_for_nothing(const Advice& a) {
  return a.kind == Advice::Kind::told || a.kind == Advice::Kind::unlike;
}

/// Whether readings that agree otherwise ask for another gravity.
bool gravity_is_off(const Diagnosis& d) {
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  return d.verdict == Verdict::consistent && beyond != nullptr && beyond->scales;
}

/// What is to be looked up where several recordings are not explained, before anything is added to
/// the model: it may be what they do not have in common.
std::string apart_next(const Diagnosis& d) {
  if (d.verdict != Verdict::unexplained || d.proposal || d.where.recordings.size() < 2) return "";
  if (d.nearest_known && std::ranges::find(d.nearest_known->effects, "latitude_error",
                                           &NamedEffect::term) != d.nearest_known->effects.end())
    return "Next: diagnose each recording alone: they may be of several places, and [site] is one "
           "for all of them.";
  return lacking_in_some_next(d.not_examined, d.where.recordings);
}

/// What to do next where effects come near; a covariate that no recording has may be another in
/// each.
std::string nearest_next(const Diagnosis& d, const remark::StrongestLeft& left) {
  const std::string before =
      d.where.recordings.size() > 1 ? lacking_in_all_text(d.not_examined) : "";
  return fmt::format(
      "Next: {}ore than one effect, or one of another shape, seems to be missing. {}",
      before.empty() ? "m" : before + ". M", diagnosed_with(d.nominal, left.labels.front()));
}

/// What to do next; empty where nothing is to be done. off_zero: a gimbal's zero is off.
std::string next_step(const Diagnosis& d, bool off_zero) {
  if (labels_are_late(d))
    return "Next: correct the numbers of the positions in the recording and diagnose again.";
  if (const auto* left_out = remark_in<remark::LoopLeftOut>(d))
    return loop_next(left_out->loop, d.nominal, 0, "diagnose");
  if (d.heading_doubt) return corrected_text(*d.heading_doubt, "diagnose");
  if (d.site_doubt && d.site_doubt->clock) return clock_next(*d.site_doubt->clock, "diagnose");
  if (d.site_doubt) return latitude_next(*d.site_doubt, "diagnose");
  if (const auto* noise = remark_in<remark::IncredibleNoise>(d))
    return fmt::format(
        "Next: look at the rows of the {}, their unit and the noise that [readout] declares; "
        "correct "
        "what is wrong and diagnose again.",
        noise->component == "gimbal_white" ? "gimbals" : "accelerometers");
  if (const auto reversed = reversed_commands(d); !reversed.empty())
    return fmt::format(
        "Next: correct the sign of {} in the recording, or in [recording] columns of the study, "
        "and diagnose again.",
        listed(reversed, "and"));
  if (gravity_is_off(d)) return gravity_next("diagnose");
  if (const std::string priors = priors_at_fault_text(d); !priors.empty()) {
    const bool several = remark_in<remark::BeyondPrior>(d)->parameters.size() > 1;
    return fmt::format(
        "Next: {}correct {}, or widen {} to hold what the fit takes, and diagnose "
        "again.",
        d.causes.empty() ? ""
                         : fmt::format("look up {} before anything is added to the model; where {} "
                                       "wrong, ",
                                       priors, several ? "they are" : "it is"),
        !d.causes.empty() ? several ? "them" : "it" : priors, several ? "them" : "it");
  }
  if (const auto* delay = remark_in<remark::DelayInstead>(d);
      delay != nullptr && d.verdict != Verdict::named)
    return delay_next(delay->delay, "diagnose");
  if (off_zero && d.verdict != Verdict::consistent)
    return "Next: correct the zero, or its offset, and diagnose again.";
  if (const std::string own = own_not_examined_next(d.not_examined, d.where.recordings);
      !own.empty() && d.verdict != Verdict::consistent)
    return own;
  if (const auto* times = remark_in<remark::TimesInstead>(d);
      times != nullptr && d.verdict != Verdict::named)
    return fmt::format(
        "Next: look up the sample interval of the log, whose times may all be {}, before anything "
        "is added to the {}.",
        times_off_text(times->clock), d.of_case ? "model" : "plan");
  if (const auto* unsure = remark_in<remark::NotPredicted>(d); unsure && unsure->of_recordings)
    return "Next: diagnose each recording alone: what was found may be in one of them only.";
  if (!d.advice.empty() && !asks_for_nothing(d.advice.front()))
    return "Next: " + advice_in_brief(d.advice);
  if (remark_in<remark::LikelierMissing>(d))
    return "Next: diagnose a second recording, a longer one if it can be had: an effect comes "
           "again, noise does not.";
  if (const std::string apart = apart_next(d); !apart.empty()) return apart;
  if (d.verdict == Verdict::named && d.has_patch)
    return fmt::format(
        "Next: {}identify with patched.toml, the study with the cause in its model{}{}.",
        remark_in<remark::TimesInstead>(d) != nullptr
            ? "look up the sample interval of the log; where its times are right, "
            : "",
        declares_noise(d) ? " and the noise that was found" : "",
        priors_taken_text(d).empty() ? "" : " and room in " + priors_taken_text(d));
  if (const auto other = facts(d.nominal.coupling).other;
      other && std::ranges::find(d.causes, closure_term, &search::Cause::term) != d.causes.end())
    return fmt::format(
        "Next: diagnose again under the other equation, and see what is missing: --set {}.",
        shell_word(fmt::format("{}={}", key_of_nominal(d.nominal, "coupling"), key_of(*other))));
  if (declares_noise(d))
    return fmt::format(
        "Next: identify with patched.toml, the study with the noise that was found{}: the sigmas "
        "of identify are of the noise that is declared.",
        not_declared(d).empty()
            ? ""
            : fmt::format(" but for {}, for want of a key", listed(not_declared(d), "and")));
  // What and where, for the sentences that have it may have no room in the short answer.
  if (const std::string place = place_text(d.where); d.proposal)
    return fmt::format(
        "Next: look for what acts as {} += {}{}{}. Then try the [[term]] of proposal.toml on "
        "another recording.",
        d.proposal->acts_on, d.proposal->equation, place.empty() ? "" : ", ", place);
  if (const auto left = strongest_left(d); d.verdict == Verdict::unexplained && left)
    return nearest_next(d, *left);
  return d.advice.empty() ? "" : "Next: " + advice_in_brief(d.advice);
}

}  // namespace

std::string verdict_word(const Diagnosis& d) {
  if (d.heading_doubt)
    return d.heading_doubt->alone() ? "Wrong headings: correct the study first."
                                    : "Wrong headings and more: correct the study first.";
  if (d.site_doubt && d.site_doubt->clock) return "Wrong times: correct the recording first.";
  if (d.site_doubt)
    return fmt::format("Wrong {}{}: correct the study first.", wrong_text(*d.site_doubt),
                       nothing_else(*d.site_doubt) ? "" : " and more");
  switch (d.verdict) {
    case Verdict::consistent:
      return but_far_from_priors(d).empty()
                 ? "Consistent: nothing significant is missing."
                 : "Consistent, but far from its priors: nothing else is missing.";
    case Verdict::named:
      return "Named: the data single out what is missing.";
    case Verdict::ambiguous:
      return remark_in<remark::LikelierMissing>(d)
                 ? "Ambiguous: something may be missing, or it is noise."
                 : "Ambiguous: something is missing, and several causes remain possible.";
    case Verdict::unexplained:
      break;
  }
  return "Unexplained: something is missing that no candidate fits.";
}

std::string headline(const Diagnosis& d) {
  const auto wrong = [](std::string_view what, bool alone) {
    return fmt::format("wrong {}{}", what, alone ? "" : " and more");
  };
  const std::string word = d.heading_doubt ? wrong("headings", d.heading_doubt->alone())
                           : d.site_doubt && d.site_doubt->clock ? wrong("times", true)
                           : d.site_doubt
                               ? wrong(wrong_text(*d.site_doubt), nothing_else(*d.site_doubt))
                               : std::string(text(d.verdict));
  return fmt::format("Verdict {}: {}", word, sentence(d));
}

InBrief diagnosis_in_brief(const Diagnosis& d) {
  InBrief brief;
  brief.verdict = headline(d);
  // Another prior, and the verdict would be another.
  if (d.verdict == Verdict::named && nearest_is_too_large(d))
    brief.kept = too_large_text(d).substr(1);
  brief.tone = d.wrong_study() ? Tone::bad
               : d.verdict == Verdict::consistent && but_far_from_priors(d).empty() &&
                       remark_in<remark::LoopLeftOut>(d) == nullptr
                   ? Tone::good
               : d.verdict == Verdict::named || d.verdict == Verdict::consistent ||
                       remark_in<remark::LikelierMissing>(d)
                   ? Tone::doubtful
                   : Tone::bad;
  const auto add = [&](Weight weight, std::string_view head, const std::string& sentence) {
    if (!sentence.empty()) brief.more.add(weight, fmt::format("{}: {}", head, sentence));
  };
  if (d.verdict != Verdict::consistent && !d.wrong_study()) {
    if (d.proposal)
      add(Weight::note, "Proposal", form_sentence(*d.proposal));
    else if (const auto* period = remark_in<remark::PeriodExplains>(d);
             period && !period->beside_cause)
      add(Weight::note, "Period", in_words(Remark(*period), instrument_of(d)));
    add(Weight::note, "Where", where_sentence(d.where, time_unit(d)));
    add(Weight::note, "Held out", held_out_sentence(d.fit.held_out));
  }
  bool off_zero = false;
  for (const Remark& r : d.remarks)
    if (const auto* gyro = std::get_if<remark::SaturatedGyro>(&r))
      add(Weight::wrong, "Range", gyro->text + ".");
    else if (const auto* gimbal = std::get_if<remark::GimbalOffZero>(&r)) {
      add(Weight::wrong, "Gimbals", gimbal->text + ".");
      off_zero = true;
    }
  const bool at_fault = labels_are_late(d) || !priors_at_fault_text(d).empty() ||
                        (d.verdict == Verdict::named && !priors_taken_text(d).empty());
  for (const auto& [head, sentence] : doubts_of(d))
    if (head == loop_left_out || !d.wrong_study())
      add(at_fault || head == loop_left_out                               ? Weight::wrong
          : d.verdict == Verdict::unexplained && head != beyond_its_prior ? Weight::note
                                                                          : Weight::doubtful,
          head, sentence);
  if (!d.wrong_study())
    add(Weight::doubtful, "Not examined",
        own_not_examined_text(d.not_examined, d.where.recordings));
  brief.next = next_step(d, off_zero);
  return brief;
}

}  // namespace drift::report
