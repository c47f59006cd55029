#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/identification/absent_channels.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/input_doubts.hpp"
#include "analysis/report/identify/judgement.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/turned_words.hpp"

namespace drift::report {
namespace {

/// How many parameters are worth what, and which: "14 learned, 4 prior only (eta_y, ...)".
std::string count_text(const FilterView& v) {
  constexpr std::size_t most = 6;
  struct Kind {
    Worth worth;
    std::string_view words;
    std::vector<std::string> keys;
  } kinds[] = {{Worth::wrong, "wrong by more than 5 sigma", {}},
               {Worth::untrusted, "not to be trusted", {}},
               {Worth::start_dependent, "dependent on the start", {}},
               {Worth::prior_only, "prior only", {}},
               {Worth::sum_only, "known in sums with others alone", {}},
               {Worth::learned, "learned", {}}};
  ParameterVerdict worst;
  for (std::size_t k = 0; k < v.summary.layout.size(); ++k) {
    const ParameterVerdict p = verdict_of(v, k);
    for (Kind& kind : kinds)
      if (kind.worth == p.worth) kind.keys.push_back(parameter_key(p.param));
    if (p.worth == Worth::wrong && (worst.worth != Worth::wrong || p.off > worst.off)) worst = p;
  }
  std::vector<std::string> parts;
  for (const Kind& kind : kinds) {
    if (kind.keys.empty()) continue;
    std::string part = fmt::format("{} {}", kind.keys.size(), kind.words);
    if (kind.worth == Worth::wrong)
      part += fmt::format(" (worst {}: {:.0f})", parameter_key(worst.param), worst.off);
    else if (kind.worth != Worth::learned && kind.worth != Worth::untrusted)
      part += fmt::format(" ({})", listed_up_to(kind.keys, most));
    parts.push_back(std::move(part));
  }
  return fmt::format("Filter {}: of {} parameters {}.", v.spec().name, v.summary.layout.size(),
                     fmt::join(parts, "; "));
}

/// Whether the truth is known and a parameter is not.
bool any_wrong(const FilterView& v) {
  for (std::size_t k = 0; k < v.summary.layout.size(); ++k)
    if (verdict_of(v, k).worth == Worth::wrong) return true;
  return false;
}

/// What the answer is of, where instruments that the study asks for show nothing:
/// "gimbal angles alone: the recording has no accelerometers (acc_x, acc_y, acc_z)".
std::string absent_text(const identification::Identification& id) {
  if (id.absent.empty()) return "";
  const std::string who = id.sources.size() > 1 ? "no recording has" : "the recording has no";
  const std::string keys = fmt::format("{}", fmt::join(id.absent, ", "));
  if (id.absent.size() == 3 && identification::lacks(id.absent, accelerometer_channels))
    return fmt::format("gimbal angles alone: {} accelerometers ({})", who, keys);
  if (id.absent.size() == 3 && identification::lacks(id.absent, gimbal_channels))
    return fmt::format("accelerometers alone: {} gimbal angles ({})", who, keys);
  return fmt::format("without {0}: {1} {0}", keys, who);
}

std::string absent_positions_text(const std::vector<int>& positions) {
  return positions.empty() ? "" : fmt::format("without {} of the plan", positions_text(positions));
}

std::string headings_text(const identification::HeadingDoubt& doubt) {
  return fmt::format(
      "{}. Then chi-square per degree of freedom is {} instead of {}{} (chance of the plan as it "
      "is: "
      "{}). Only the Earth's rotation shows where North is.",
      turned_text(doubt), number_text(doubt.chi2_per_dof_after),
      number_text(doubt.chi2_per_dof_before),
      doubt.alone() ? "" : ", where 1 is expected: something else is missing, too",
      p_text(doubt.chance));
}

/// What follows "Fits, with less noise than declared:".
std::string smaller_text(const Judgement& j, const identification::Identification& id) {
  std::vector<std::string> others = j.bad;
  others.insert(others.end(), j.leave_more.begin(), j.leave_more.end());
  return fmt::format(
      "the residuals are about {}{}. The estimates stand, their sigmas are too wide. {}.",
      listed(j.less_noise, "and"), others.empty() ? "" : "; " + listed(others, "and"),
      id.simulated ? "The noise is smaller than declared"
                   : "The noise is smaller than declared, or rows were joined whose noise is not "
                     "white");
}

std::string nearly_text(const std::vector<std::string>& filters) {
  return fmt::format("the residuals of {} {} are not within the 95 % band of a right model",
                     filters.size() == 1 ? "filter" : "filters", listed(filters, "and"));
}

std::vector<std::string> names_of(const mc::Study& study, const std::vector<std::size_t>& filters) {
  std::vector<std::string> names;
  for (const std::size_t k : filters) names.push_back(study.filters[k].name);
  return names;
}

/// "it is 750 times as probable as six, which fits as well"
std::string odds_text(const mc::Study& study, const identification::Favoured& favoured) {
  constexpr double most = 1e6;  // beyond it the number says nothing, and a Gaussian is none
  const double odds = std::exp(favoured.log_odds);
  const bool several = favoured.others.size() > 1;
  return fmt::format("{} {} times as probable as {}{}, which fit{} as well",
                     favoured.filters.size() > 1 ? "together they are" : "it is",
                     odds < most ? number_text(odds, 2) : "more than a million",
                     listed(names_of(study, favoured.others), "and"), several ? " together" : "",
                     several ? "" : "s");
}

/// Which filters to believe where others are not to be, and why.
template <class JudgedAs>
std::string believed_text(const mc::Study& study, const Judgement& j, JudgedAs&& judged_as) {
  std::vector<std::string> who = j.good, why, nearly;
  if (j.favoured) who = names_of(study, j.favoured->filters);
  for (const std::string& name : who)
    if (std::ranges::find(j.nearly, name) != j.nearly.end()) nearly.push_back(name);
  why.push_back(!nearly.empty() ? nearly_text(nearly)
                                : fmt::format("the residuals are what {}",
                                              who.size() == 1 ? "it expects" : "they expect"));
  if (j.favoured) why.push_back(odds_text(study, *j.favoured));
  why.insert(why.end(), j.bad.begin(), j.bad.end());
  return fmt::format("{} {}.",
                     judged_as(fmt::format("Believe {}{}", listed(who, "and"),
                                           nearly.size() < who.size() ? ""
                                           : who.size() == 1          ? ", which fits nearly"
                                                                      : ", which fit nearly")),
                     fmt::join(why, "; "));
}

std::string verdict_text(const mc::Study& study, const Judgement& j,
                         const identification::Identification& id) {
  std::vector<std::string> limits;
  for (const std::string& limit : {absent_text(id), absent_positions_text(id.absent_positions)})
    if (!limit.empty()) limits.push_back(limit);
  const std::string absent = listed(limits, "and");
  const auto judged_as = [&](std::string_view word) {
    return absent.empty() ? fmt::format("{}:", word) : fmt::format("{}, {};", word, absent);
  };
  if (const auto* doubt = other_headings(id))
    return fmt::format("{} {}", judged_as(j.good.empty() ? "Misfit" : "Wrong headings"),
                       headings_text(*doubt));
  if (const auto doubt = other_latitude(id); doubt && doubt->clock)
    return fmt::format("{} {}", judged_as(j.good.empty() ? "Misfit" : "Wrong times"),
                       clock_text(*doubt));
  const auto wrong = [&](const identification::LatitudeDoubt& doubt) {
    return judged_as(j.good.empty() ? "Misfit" : fmt::format("Wrong {}", wrong_text(doubt)));
  };
  if (const auto doubt = other_latitude(id); doubt && !doubt->alone())
    return fmt::format(
        "{} the latitude of [site] is not that of the recording, and something else is missing: at "
        "about {:.1f} deg instead of {:.3f} deg chi-square per degree of freedom is {} instead of "
        "{}, where 1 is expected{}.",
        wrong(*doubt), doubt->latitude / unit::deg.to_si, doubt->declared / unit::deg.to_si,
        number_text(doubt->chi2_per_dof_after), number_text(doubt->chi2_per_dof_before),
        or_clock_text(*doubt));
  if (const auto doubt = other_latitude(id))
    return fmt::format(
        "{} the latitude of [site] is not that of the recording. At {} instead of {:.3f} "
        "deg chi-square per degree of freedom is {} instead of {}{}: correct {} first.",
        wrong(*doubt), latitude_text(*doubt), doubt->declared / unit::deg.to_si,
        number_text(doubt->chi2_per_dof_after), number_text(doubt->chi2_per_dof_before),
        or_clock_text(*doubt), doubt->or_clock ? "one or the other" : "it");
  if (j.good.empty())
    return fmt::format("{} {}. {} estimates are not to be trusted.", judged_as("Misfit"),
                       listed(j.bad, "and"), j.bad.size() == 1 ? "Its" : "Their");
  if (!j.less_noise.empty())
    return fmt::format("{} {}", judged_as("Fits, with less noise than declared"),
                       smaller_text(j, id));
  if (!j.bad.empty() || j.favoured) return believed_text(study, j, judged_as);
  if (!j.nearly.empty())
    return fmt::format("{} {}.", judged_as("Fits nearly"), nearly_text(j.nearly));
  return fmt::format("{} the residuals are what {} {} expect{}.", judged_as("Fits"),
                     j.good.size() == 1 ? "filter" : "filters", listed(j.good, "and"),
                     j.good.size() == 1 ? "s" : "");
}

}  // namespace

InBrief identification_in_brief(const mc::Study& study, const identification::Identification& id) {
  const Judgement j = judgement_of(study, id);
  InBrief brief;
  brief.verdict = verdict_text(study, j, id);
  bool doubtful =
      j.wrong || !j.less_noise.empty() || !id.absent.empty() || !id.absent_positions.empty();
  for (const InputDoubt& doubt : input_doubts(study, id, !j.good.empty())) {
    brief.more.add(doubt.weight, fmt::format("{}: {}", doubt.head, doubt.text));
    doubtful = doubtful || doubt.weight != Weight::note;
  }
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView view{study, id, s};
    const auto add = [&](Weight weight, const std::string& said) {
      if (!said.empty()) brief.more.add(weight, said);
    };
    for (const auto text :
         {other_start_text, which_counts, considered_text, remembered_text, outside_text})
      add(Weight::doubtful, text(view));
    const SaidOfPriors priors = priors_text(view);
    add(priors.weight, priors.text);
    if (const auto common = identification::common_scale(judged(view)); common && believed(view))
      add(Weight::wrong, "Gravity: " + common_scale_text(*common));
    add(any_wrong(view) ? Weight::wrong : Weight::note, count_text(view));
    doubtful = doubtful || !remembered_text(view).empty() ||
               (believed(view) && !beyond_prior(view).empty());
  }
  const bool wrong_study = other_headings(id) != nullptr || other_latitude(id).has_value();
  brief.tone = j.good.empty() || wrong_study ? Tone::bad : doubtful ? Tone::doubtful : Tone::good;
  brief.next = next_step(study, id, j);
  return brief;
}

}  // namespace drift::report
