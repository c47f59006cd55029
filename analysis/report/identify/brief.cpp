#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "analysis/identification/absent_channels.hpp"
#include "analysis/identification/beyond_prior.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/report/identify/clock_words.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/identify/sections.hpp"
#include "analysis/report/identify/turned_words.hpp"
#include "analysis/report/page/study_words.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::report {
namespace {

std::string misfit_text(const FilterView& v) {
  const EstimateResult& result = judged(v);
  return result.status != EstimateStatus::ok
             ? "did not converge"
             : fmt::format("misfits (chi-square per degree of freedom {}, 1 expected)",
                           number_text(result.statistic_per_dof()));
}

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

/// A fit that is not a misfit may still be one that few right models have.
std::string outside_text(const FilterView& v) {
  const EstimateResult& result = judged(v);
  if (!believed(v) || fit_cell(result).tone == Tone::plain) return "";
  const auto dof = static_cast<double>(result.measured);
  const stats::Band band = stats::chi_square_band(dof);
  return fmt::format(
      "Filter {}: chi-square per degree of freedom {:.3f} is outside the 95 % band of a right "
      "model, {:.3f} to {:.3f} (so far by chance: {:.1g}): a small effect is missing, or noise and "
      "priors are not what the study says.",
      v.spec().name, result.statistic_per_dof(), band.low, band.high,
      stats::chi_square_chance(result.statistic_per_dof(), dof));
}

/// Parameters that no prior of the study would have where the filter takes them.
std::string beyond_text(const FilterView& v) {
  constexpr std::size_t most = 6;
  const std::vector<std::string> keys = beyond_prior(v);
  if (keys.empty()) return "";
  const bool one = keys.size() == 1;
  return fmt::format(
      "Filter {}: {} further than {:g} of {} prior sigmas from {} ({}): wrong priors, missing "
      "physics, or a study that is not of this recording (latitude, axes, unit of time).",
      v.spec().name, one ? "1 parameter lies" : fmt::format("{} parameters lie", keys.size()),
      inference::FitLimits::beyond_prior, one ? "its" : "their",
      one ? "its prior's mean" : "the means of their priors", listed_up_to(keys, most));
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

struct Judgement {
  std::vector<std::string> good, bad;  ///< names; what is wrong with them
  std::vector<std::string> nearly;     ///< names of good ones that few right models fit as badly as
  bool wrong = false;                  ///< a filter that fits has a parameter that is wrong
  bool unlearned = false;              ///< a filter that fits learned nothing of one
  bool first_fits = false;             ///< the first filter, which `diagnose` would examine
};

Judgement judgement_of(const mc::Study& study, const identification::Identification& id) {
  Judgement j;
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView v{study, id, s};
    if (!believed(v)) {
      j.bad.push_back(fmt::format("filter {} {}", v.spec().name, misfit_text(v)));
      continue;
    }
    j.good.push_back(v.spec().name);
    if (!outside_text(v).empty()) j.nearly.push_back(v.spec().name);
    j.first_fits = j.first_fits || s.filter == 0;
    for (std::size_t k = 0; k < s.layout.size(); ++k) {
      const Worth worth = verdict_of(v, k).worth;
      j.wrong = j.wrong || worth == Worth::wrong;
      j.unlearned = j.unlearned || worth == Worth::prior_only || worth == Worth::sum_only;
    }
  }
  return j;
}

/// The latitude that explains the misfit of a filter; empty if none does.
std::optional<identification::LatitudeDoubt> other_latitude(
    const identification::Identification& id) {
  for (const identification::FilterSummary& s : id.summaries)
    if (s.latitude_doubt) return s.latitude_doubt;
  return std::nullopt;
}

/// The headings that explain it.
const identification::HeadingDoubt* other_headings(const identification::Identification& id) {
  for (const identification::FilterSummary& s : id.summaries)
    if (s.heading_doubt) return &*s.heading_doubt;
  return nullptr;
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

std::string verdict_text(const Judgement& j, const identification::Identification& id) {
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
  if (!j.bad.empty())
    return fmt::format("{} the residuals are what it expects; {}.",
                       judged_as("Believe " + listed(j.good, "and")), listed(j.bad, "and"));
  if (!j.nearly.empty())
    return fmt::format("{} the residuals of {} {} are not within the 95 % band of a right model.",
                       judged_as("Fits nearly"), j.nearly.size() == 1 ? "filter" : "filters",
                       listed(j.nearly, "and"));
  return fmt::format("{} the residuals are what {} {} expect{}.", judged_as("Fits"),
                     j.good.size() == 1 ? "filter" : "filters", listed(j.good, "and"),
                     j.good.size() == 1 ? "s" : "");
}

}  // namespace

std::vector<std::string> beyond_prior(const FilterView& v) {
  auto far = identification::beyond_prior(judged(v));
  std::ranges::stable_sort(far, std::greater{}, &identification::BeyondPrior::sigmas);
  std::vector<std::string> keys;
  for (const identification::BeyondPrior& p : far) keys.push_back(parameter_key(p.param));
  return keys;
}

/// What to add where a filter has a covariate from the recording, which a plan has not.
std::string covariates_to_rank_with(const mc::Study& study) {
  const CovariateSet missing = TermLibrary::needs(study.filters.front().model().terms).covariates &
                               ~study.environment.declared();
  std::string all;
  for (const CovariateSpec& c : known_covariates)
    if (!c.is_vector() && (missing & c.set()) != 0)
      all += fmt::format(
          " It needs the {} that is to be expected: --set environment.{}={} --set "
          "environment.{}_amplitude=\"{:g} {}\"",
          c.what, c.name, c.example, c.name, 0.2 * c.usual, c.unit.symbol.view());
  return all;
}

InBrief identification_in_brief(const mc::Study& study, const identification::Identification& id) {
  const Judgement j = judgement_of(study, id);
  InBrief brief;
  brief.verdict = verdict_text(j, id);
  bool doubtful = j.wrong || !id.absent.empty() || !id.absent_positions.empty() ||
                  !id.off_zero.empty() || !id.spikes.empty();
  if (!id.off_zero.empty()) brief.more.add(Weight::wrong, "Gimbals: " + id.off_zero + ".");
  const std::string labels = late_labels_text(id.spikes);
  if (!labels.empty())
    brief.more.add(Weight::wrong, "Labels: " + labels);
  else if (!id.spikes.empty())
    brief.more.add(j.good.empty() ? Weight::wrong : Weight::doubtful,
                   fmt::format("Outliers: {} isolated sample{} far from those around{}, and in the "
                               "fit: leave {} out (an "
                               "empty cell).",
                               id.spikes.size(), id.spikes.size() == 1 ? " is" : "s are",
                               spikes_text(id.spikes), id.spikes.size() == 1 ? "it" : "them"));
  for (const identification::FilterSummary& s : id.summaries) {
    const FilterView view{study, id, s};
    const auto add = [&](Weight weight, const std::string& said) {
      if (!said.empty()) brief.more.add(weight, said);
    };
    for (const auto text :
         {other_start_text, which_counts, considered_text, remembered_text, outside_text})
      add(Weight::doubtful, text(view));
    add(Weight::wrong, beyond_text(view));
    if (const auto common = identification::common_scale(judged(view)); common && believed(view))
      add(Weight::wrong, "Gravity: " + common_scale_text(*common));
    add(any_wrong(view) ? Weight::wrong : Weight::note, count_text(view));
    doubtful = doubtful || !remembered_text(view).empty() ||
               (believed(view) && !beyond_prior(view).empty());
  }
  const bool wrong_study = other_headings(id) != nullptr || other_latitude(id).has_value();
  brief.tone = j.good.empty() || wrong_study ? Tone::bad : doubtful ? Tone::doubtful : Tone::good;
  if (!labels.empty())
    brief.next = "Next: correct the numbers of the positions in the recording and identify again.";
  else if (const auto* headings = other_headings(id))
    brief.next = corrected_text(*headings, "identify");
  else if (const auto doubt = other_latitude(id); doubt && (doubt->clock || doubt->alone()))
    brief.next =
        doubt->clock ? clock_next(*doubt->clock, "identify") : latitude_next(*doubt, "identify");
  else if (!id.off_zero.empty())
    brief.next = "Next: correct the zero, or its offset, and identify again.";
  else if (j.good.empty() && !id.spikes.empty() && !other_latitude(id))
    brief.next = fmt::format(
        "Next: leave the isolated sample{} out (empty cells) and identify again; `driftscope "
        "diagnose` leaves {} out by itself.",
        id.spikes.size() == 1 ? "" : "s", id.spikes.size() == 1 ? "it" : "them");
  else if (!j.first_fits)
    brief.next = fmt::format(
        "Next: {}driftscope diagnose {} {} says what the first filter of the study lacks.",
        other_latitude(id) ? "correct the latitude by a map; then " : "", study_words(study),
        id.simulated ? "RECORDING" : shell_words(id.sources));
  else if (j.unlearned)
    brief.next = fmt::format(
        "Next: driftscope rank {} --improve 3 proposes positions that show what this test does "
        "not.{}",
        study_words(study), covariates_to_rank_with(study));
  return brief;
}

}  // namespace drift::report
