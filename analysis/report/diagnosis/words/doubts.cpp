#include "analysis/report/diagnosis/words/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/diagnosis/words/alternative_words.hpp"
#include "analysis/report/diagnosis/words/effect_words.hpp"
#include "analysis/report/diagnosis/words/field_words.hpp"
#include "analysis/report/diagnosis/words/remark_words.hpp"
#include "analysis/report/diagnosis/words/verdict_openings.hpp"
#include "analysis/report/diagnosis/words/words.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/delay_words.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/turned_words.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/number_text.hpp"
#include "core/base/units.hpp"
#include "core/base/words.hpp"

namespace drift::report {
using namespace diagnosis;

namespace {

constexpr std::size_t most_keys = 6;

std::vector<std::string> keys_of(const remark::BeyondPrior& r) {
  std::vector<std::string> keys;
  for (const remark::BeyondPrior::Parameter& p : r.parameters)
    keys.push_back(parameter_key(p.estimate.param));
  return keys;
}

std::string priors_text(const remark::BeyondPrior& r) {
  return fmt::format("the prior{} of {}", r.parameters.size() > 1 ? "s" : "",
                     listed_up_to(keys_of(r), most_keys));
}

/// "cmd_x" of s_x at -2.
std::vector<std::string> reversed_by(const remark::BeyondPrior& r) {
  std::vector<std::string> columns;
  for (const remark::BeyondPrior::Parameter& p : r.parameters) {
    const ParameterEstimate& e = p.estimate;
    const std::string key = parameter_key(e.param);
    if ((key == "s_x" || key == "s_y" || key == "s_z") &&
        std::abs(e.value + 2.0) <=
            inference::FitLimits::beyond_prior * std::hypot(e.sigma, e.prior_sigma))
      columns.push_back("cmd" + key.substr(1));
  }
  return columns;
}

}  // namespace

std::vector<std::string> reversed_commands(const Diagnosis& d) {
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  return beyond == nullptr ? std::vector<std::string>{} : reversed_by(*beyond);
}

std::string priors_at_fault_text(const Diagnosis& d) {
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  return beyond == nullptr || !beyond->explains ? "" : priors_text(*beyond);
}

std::string priors_taken_text(const Diagnosis& d) {
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  return beyond == nullptr || !beyond->taken || d.causes.empty() ? "" : priors_text(*beyond);
}

std::string wrong_priors_text(const Diagnosis& d) {
  constexpr std::string_view nothing_left = "with more room there nothing is missing";
  const std::string priors = priors_at_fault_text(d);
  if (priors.empty()) return "";
  if (d.verdict == Verdict::consistent)
    return fmt::format("{} but for {}: {}.", agrees, priors, nothing_left);
  const std::string missing =
      fmt::format("{} (chance of a false alarm: {})", something_missing, p_text(d.p_value));
  const std::vector<CauseIndices> causes = alternatives_of(d);
  if (causes.empty()) return fmt::format("{}, or it is {}: {}.", missing, priors, nothing_left);
  std::string words;
  for (std::size_t k = 0; k < causes.size(); ++k)
    words += fmt::format(", or {}{}", causes.size() > 1 ? fmt::format("({}) ", k + 1) : "",
                         together(d, causes[k]));
  return fmt::format("{}, and {} cannot tell which: either {} (probability {}: {}){}.", missing,
                     positions_at_hand(d), priors, decimal_text(d.probabilities.wrong_priors, 2),
                     nothing_left, words);
}

std::string beside_priors_text(const Diagnosis& d, const std::string& noise) {
  if (d.verdict != Verdict::consistent || noise.empty()) return "";
  return remark_in<remark::BeyondPrior>(d)->noise_beside ? noise : " Or else:" + noise;
}

std::string other_priors_text(const remark::OtherPriors& r, Instrument instrument) {
  std::vector<std::string> keys, effects;
  for (const std::size_t i : r.parameters) keys.push_back(parameter_key(i));
  for (const NamedEffect& e : r.effects)
    effects.push_back(fmt::format("{} ({})", in_words(e.term, e.axis, instrument), e.label));
  const bool several = keys.size() > 1, wrong = r.are == remark::OtherPriors::Are::wrong;
  return fmt::format("{}, and {} missing",
                     !wrong ? "all priors are right"
                            : fmt::format("the prior{} of {} {} wrong", several ? "s" : "",
                                          listed_up_to(keys, most_keys), several ? "are" : "is"),
                     effects.empty()
                         ? "something that no known effect explains is"
                         : listed(effects, "and") + (effects.size() > 1 ? " are" : " is"));
}

std::string but_far_from_priors(const Diagnosis& d) {
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  if (beyond == nullptr) return "";
  const bool several = beyond->parameters.size() > 1;
  return fmt::format(", but the fit takes {} {}{:.1f} prior sigmas from {}: {}",
                     listed_up_to(keys_of(*beyond), most_keys), several ? "up to " : "",
                     beyond->farthest().sigmas, several ? "their priors" : "its prior",
                     beyond->scales ? "the gravity, or the unit of the accelerometers, is wrong"
                     : several      ? "wrong priors, or something that they take up"
                                    : "a wrong prior, or something that it takes up");
}

std::string beyond_prior_text(const remark::BeyondPrior& r) {
  const std::vector<std::string> keys = keys_of(r);
  const remark::BeyondPrior::Parameter& far = r.farthest();
  const ParameterEstimate& e = far.estimate;
  const double unit = unit_of(e.param);
  const std::string where = fmt::format(
      "{:.1f} prior sigmas from {}", far.sigmas,
      keys.size() > 1
          ? "their priors"
          : fmt::format("its prior, {} {} against {}±{}",
                        with_sigma(e.value / unit, e.sigma / unit), parameter_unit(e.param),
                        number_text(e.prior_mean / unit), number_text(e.prior_sigma / unit)));
  const std::string chance =
      fmt::format("chance of that for any of {} parameters: {}", r.of, p_text(far.chance));
  if (const auto reversed = reversed_by(r); !reversed.empty())
    return fmt::format("The fit takes {} {}{} ({}): a scale of -2 is a gain of -1, the sign of {}",
                       listed_up_to(keys, most_keys), keys.size() > 1 ? "up to " : "", where,
                       chance, listed(reversed, "and"));
  return keys.size() > 1
             ? fmt::format(
                   "The fit takes {} up to {} ({}): the priors are wrong, or these parameters take "
                   "up something that the model lacks",
                   listed_up_to(keys, most_keys), where, chance)
             : fmt::format(
                   "The fit takes {} {} ({}): the prior is wrong, or {} takes up something that "
                   "the model lacks",
                   keys.front(), where, chance, keys.front());
}

std::string site_text(const identification::LatitudeDoubt& doubt) {
  if (doubt.clock)
    return clock_text(doubt) + " Correct them before anything else is made of the recording.";
  if (!doubt.alone())
    return fmt::format(
        "The latitude of [site] is not that of the recording, and that is not all: at about "
        "{:.1f} deg instead of {:.3f} deg the model fits with chi-square per degree of freedom "
        "{:.3g} instead of {:.3g}, where 1 is expected (by chance: {}). Something else is missing "
        "too, or the noise is not as declared, and it moves the latitude that fits.",
        doubt.latitude / unit::deg.to_si, doubt.declared / unit::deg.to_si,
        doubt.chi2_per_dof_after, doubt.chi2_per_dof_before, p_text(doubt.chance_after));
  return fmt::format(
      "The latitude of [site] is not that of the recording: at {} instead of {:.3f} deg "
      "the model fits with chi-square per degree of freedom {:.3g} instead of {:.3g}. No "
      "survey is wrong by so much (latitude_error would need {:.3g} prior sigmas){}: correct the "
      "{} and diagnose again before anything else is made of it.",
      latitude_text(doubt), doubt.declared / unit::deg.to_si, doubt.chi2_per_dof_after,
      doubt.chi2_per_dof_before, doubt.prior_sigmas(), or_clock_text(doubt),
      doubt.or_clock ? "one or the other" : "latitude");
}

std::string site_and_more_text(const identification::LatitudeDoubt& doubt) {
  return fmt::format(
      "The latitude of [site] is not that of the recording{}: at {} instead of {:.3f} deg, with "
      "what is missing there in the model, chi-square per degree of freedom is {:.3g} instead of "
      "{:.3g}{}.",
      doubt.alone() ? "" : ", and that is not all", latitude_text(doubt),
      doubt.declared / unit::deg.to_si, doubt.chi2_per_dof_after, doubt.chi2_per_dof_before,
      or_clock_text(doubt));
}

std::string heading_text(const identification::HeadingDoubt& doubt) {
  return fmt::format(
      "{}: then the model fits with chi-square per degree of freedom {:.3g} instead of {:.3g}, "
      "where "
      "1 is expected (chance of the plan as it is: {}). No accelerometer and no gimbal shows where "
      "North is, "
      "the Earth's rotation does.{} Correct axes and case headings and diagnose again before "
      "anything else is made of it.",
      turned_text(doubt), doubt.chi2_per_dof_after, doubt.chi2_per_dof_before, p_text(doubt.chance),
      doubt.alone() ? "" : " Something else is missing too, or the noise is not as declared.");
}

bool labels_are_late(const Diagnosis& d) {
  const auto* samples = remark_in<remark::SamplesLeftOut>(d);
  return samples != nullptr && identification::late_labels(samples->removed) > 0;
}

const remark::TimesInstead* times_beside_cause(const Diagnosis& d) {
  const bool for_others = remark_in<remark::JustSignificantLeft>(d) ||
                          remark_in<remark::LambdaNotSettled>(d) || remark_in<remark::OrNoise>(d) ||
                          remark_in<remark::MemberNotConfirmed>(d) ||
                          remark_in<remark::NotPredicted>(d);
  if (d.verdict != Verdict::ambiguous || for_others || alternatives_of(d).size() != 1)
    return nullptr;
  return remark_in<remark::TimesInstead>(d);
}

std::string input_instead_text(const Diagnosis& d) {
  if (const auto* delay = remark_in<remark::DelayInstead>(d))
    return fmt::format(
        "accelerometers and gimbals of different instants leave as little{}",
        delay->odds > inference::RemarkLimits::decided ? " and are far likelier" : "");
  const auto* times = times_beside_cause(d);
  return times != nullptr ? times_as_little_text(times->clock, times->odds) : "";
}

std::string instants_text(const Diagnosis& d) {
  const auto* delay = remark_in<remark::DelayInstead>(d);
  return delay != nullptr ? delay_text(delay->delay) + " " : "";
}

Json instants_json(const Diagnosis& d) {
  const auto* delay = remark_in<remark::DelayInstead>(d);
  if (delay == nullptr) return nullptr;
  Json json = delay_json(delay->delay);
  json["odds"] = std::isfinite(delay->odds) ? Json(delay->odds) : Json(nullptr);
  return json;
}

std::vector<std::pair<std::string, std::string>> doubts_of(const Diagnosis& d) {
  std::vector<std::pair<std::string, std::string>> all;
  const RecordingNames recordings = names_of_recordings(d.where.recordings);
  if (const auto* left_out = remark_in<remark::LoopLeftOut>(d))
    all.emplace_back(loop_left_out,
                     in_words(Remark(*left_out), instrument_of(d), d.where.recordings));
  if (const auto* beyond = remark_in<remark::BeyondPrior>(d))
    all.emplace_back(beyond_its_prior, beyond_prior_text(*beyond) + ".");
  if (const auto* beyond = remark_in<remark::BeyondPrior>(d); beyond != nullptr && beyond->scales)
    all.emplace_back("Gravity", common_scale_text(*beyond->scales));
  // Of one cause the verdict says it; behind several it would be cut off.
  if (const auto* times = remark_in<remark::TimesInstead>(d);
      times != nullptr && d.verdict == Verdict::ambiguous && times_beside_cause(d) == nullptr)
    all.emplace_back("Clock", times_in_brief(times->clock));
  if (const auto* off = remark_in<remark::MemoryOff>(d))
    all.emplace_back("Memory", memory_sentences(off->terms, off->gaps, recordings));
  const auto* samples = remark_in<remark::SamplesLeftOut>(d);
  if (labels_are_late(d))
    all.emplace_back("Labels", late_labels_text(samples->removed, recordings));
  else if (samples != nullptr && !samples->removed.empty())
    all.emplace_back(
        "Outliers",
        fmt::format("{} isolated sample{} left out{}: far from those around.",
                    samples->removed.size(), samples->removed.size() == 1 ? " is" : "s are",
                    spikes_text(samples->removed, recordings)));
  if (std::string text = field_doubt(d); !text.empty()) all.emplace_back("Field", std::move(text));
  return all;
}

Json beyond_prior_json(const Diagnosis& d) {
  Json all = Json::array();
  const auto* beyond = remark_in<remark::BeyondPrior>(d);
  if (beyond == nullptr) return all;
  for (const remark::BeyondPrior::Parameter& p : beyond->parameters) {
    const ParameterEstimate& e = p.estimate;
    const double unit = unit_of(e.param);
    all.push_back({{"key", parameter_key(e.param)},
                   {"value", e.value / unit},
                   {"sigma", e.sigma / unit},
                   {"prior_mean", e.prior_mean / unit},
                   {"prior_sigma", e.prior_sigma / unit},
                   {"unit", parameter_unit(e.param)},
                   {"prior_sigmas", p.sigmas},
                   {"chance", p.chance}});
  }
  return all;
}

}  // namespace drift::report
