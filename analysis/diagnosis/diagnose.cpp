#include "analysis/diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/diagnosis/asides.hpp"
#include "analysis/diagnosis/candidate_table.hpp"
#include "analysis/diagnosis/causes.hpp"
#include "analysis/diagnosis/compare.hpp"
#include "analysis/diagnosis/doubts/believed.hpp"
#include "analysis/diagnosis/doubts/wrong_priors.hpp"
#include "analysis/diagnosis/judge.hpp"
#include "analysis/diagnosis/located.hpp"
#include "analysis/diagnosis/noise_found.hpp"
#include "analysis/diagnosis/nominal_fit.hpp"
#include "analysis/inference/noise/gross_misfit.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/preparation/covariates.hpp"
#include "analysis/preparation/recorded_test.hpp"
#include "analysis/proposal/propose.hpp"
#include "analysis/search/other_equation.hpp"
#include "analysis/search/posterior.hpp"
#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "core/estimate/starts.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

using inference::NoiseLimits;

/// White noise as neighbouring samples differ, where the other of eq. (5) and (6) takes most of an
/// evident misfit away: what looks like noise that drives the platform is the equation then, and
/// the noise is estimated with that in the model. Empty otherwise.
std::optional<inference::NoiseEstimate> noise_beside_equation(const FilterSpec& nominal,
                                                              const MeasuredTest& test,
                                                              const BatchResult& fit) {
  FilterSpec other = nominal;
  if (!facts(nominal.coupling).other) return std::nullopt;
  other.coupling = *facts(nominal.coupling).other;
  const auto per_dof = [](const BatchResult& f) {
    return f.estimate.statistic /
           static_cast<double>(std::max<std::size_t>(1, f.estimate.measured));
  };
  if (per_dof(fit) < NoiseLimits::evident) return std::nullopt;
  const BatchResult with_other = fit_batch_from(other, test, theta_of(nominal, fit), fit.psi0_l,
                                                {.result = BatchOptions::Result::estimates});
  if (per_dof(fit) - per_dof(with_other) < NoiseLimits::other_equation * (per_dof(fit) - 1.0))
    return std::nullopt;
  const inference::LinearProblem problem = inference::linear_problem(nominal, test, fit, {});
  return inference::noise_of_differences(problem, inference::residual_of(problem, fit));
}

/// The table, fit and held-out prediction before and after the best explanation.
FitComparison compared(const search::Fitted& nominal, const search::Search& found,
                       const MeasuredTest& test, const DiagnoseOptions& options,
                       const std::vector<std::size_t>& recording_ends, Stages& stages) {
  const search::Refit* best = found.sets.empty() ? nullptr : &found.sets.front();
  FitComparison fit = compare(nominal, best, options.whiteness_draws);
  for (const Interval& interval : test.timeline.intervals) fit.residual_t.push_back(interval.t1);
  if (!best) return fit;
  std::vector<std::size_t> named;
  for (const search::Choice& c : best->choices) named.push_back(c.candidate);
  fit.held_out = held_out(nominal, best->after, test, named, found.thresholds.library_threshold,
                          {options.folds, recording_ends,
                           [&](std::size_t done, std::size_t total) { stages.step(done, total); }});
  return fit;
}

/// Profiles of the causes' parameters, where they were asked for.
std::vector<Profile> profiled(const search::Search& found, const MeasuredTest& test,
                              const std::vector<search::Cause>& causes,
                              const DiagnoseOptions& options, Stages& stages) {
  if (options.profiles == Profiles::left_out || causes.empty()) return {};
  stages.begin("profiles", 0.0);
  return profiles_of(found, test, causes);
}

/// Largest start-consistency ratio of the patched model, from the starts of the nominal one; what
/// is new starts where the fit has it.
double patched_spread(const FilterSpec& nominal, const MeasuredTest& test,
                      std::span<const Theta> starts, const search::Refit& best) {
  auto fits =
      fit_from_starts(nominal, best.filter, test, starts, theta_of(best.filter, best.after.fit));
  fits.push_back(best.after.fit);
  return start_spread(fits);
}

/// What the other of eq. (5) and (6) gains, with the best explanation in the model: without it the
/// misalignments of either equation would take the missing effect up. NaN: nothing to be said.
double other_equation_gain(const search::Search& found, const Judged& judged,
                           const MeasuredTest& test) {
  constexpr double silent = std::numeric_limits<double>::quiet_NaN();
  if (judged.verdict == Verdict::unexplained) return silent;
  if (!judged.names_causes())
    return std::isfinite(found.other_equation) ? found.other_equation : silent;
  if (found.sets.empty()) return silent;
  if (const auto& causes = found.sets.front().choices;
      causes.size() == 1 &&
      found.nominal.set.candidates[causes.front().candidate].term == closure_term)
    return found.other_equation;  // itself the cause
  const auto other = search::fit_other_equation(found.sets.front().after, test);
  return other ? other->gain : silent;
}

/// noise: what was found of it; samples that are none are noise not as declared, too.
/// other_way: about the priors, what is not in p.
Probabilities probabilities(const search::Search& found, const search::Posterior& p,
                            const Probabilities& other_way,
                            const std::vector<inference::NoiseFinding>& noise) {
  Probabilities out{
      p.consistent + p.wrong_priors, p.noise_only, p.outside, {}, p.wrong_priors, 0.0};
  if (std::ranges::any_of(noise, [](const inference::NoiseFinding& f) {
        return f.significant && f.component == "outliers";
      })) {
    out.noise_only += p.consistent;
    out.consistent = p.wrong_priors;
  }
  for (const auto& [choices, probability] : p.named)
    out.named.push_back({named_effects(found, choices), probability});
  out.consistent += other_way.consistent;
  out.noise_only += other_way.noise_only;
  out.outside += other_way.outside;
  out.other_priors = other_way.other_priors;
  out.named.insert(out.named.end(), other_way.named.begin(), other_way.named.end());
  std::ranges::stable_sort(out.named, std::greater{}, &Probabilities::Explanation::probability);
  return out;
}

template <class T>
void append(std::vector<Remark>& remarks, std::optional<T> remark) {
  if (remark) remarks.emplace_back(std::move(*remark));
}
void append(std::vector<Remark>& remarks, std::vector<Remark> more) {
  remarks.insert(remarks.end(), more.begin(), more.end());
}

}  // namespace

Diagnosis diagnose(const FilterSpec& nominal_filter, const MeasuredTest& given,
                   std::span<const Theta> starts,
                   const std::vector<preparation::Covariate>& covariates,
                   const DiagnoseOptions& options, const std::vector<std::size_t>& recording_ends) {
  const mc::ThreadCount threads(options.threads);
  Diagnosis d;
  // Shares of the whole as they usually are; a diagnosis that finds nothing ends early.
  Stages stages(d.seconds, options.progress);
  stages.begin("fit", 0.04);
  const NominalFit fitted = fit_nominal(nominal_filter, given, starts);
  const MeasuredTest test{given.timeline, given.readout, fitted.measured};

  stages.begin("examine", 0.08);
  const auto plain = noise_beside_equation(nominal_filter, test, fitted.fit);
  search::Fitted examined = plain ? search::examine(nominal_filter, test, fitted.fit, *plain)
                                  : search::examine(nominal_filter, test, fitted.fit);
  stages.begin("search", 0.5);
  Believed world =
      believed(nominal_filter, test, fitted.fit,
               search::search(std::move(examined), test, options.search), options.search);
  const FilterSpec& as_believed = world.nominal;
  search::Search& found = world.found;
  const search::Posterior& posterior = world.posterior;
  search::give_settings_room(found, test);
  const search::Fitted& nominal = found.nominal;
  const search::Refit* best = found.sets.empty() ? nullptr : &found.sets.front();

  stages.begin("held out", 0.25);
  d.fit = compared(nominal, found, test, options, recording_ends, stages);
  const auto member_gains = best && found.significant ? judge_members(nominal, test, *best, found)
                                                      : std::vector<double>{};
  const Judged judged =
      judge(nominal, found, posterior, d.fit.held_out, member_gains, options.named_by);

  stages.begin("locate", 0.06);
  // With the cause in the mean, what had been taken for noise because of it is none any more.
  const bool alarm = judged.verdict != Verdict::consistent;
  NoiseFound noise = noise_found(best && alarm ? best->after : nominal, fitted.spikes);
  if (!judged.names_causes() && found.noise_alone) noise.take(*found.noise_alone);
  const bool with_room = !alarm && world.with_room;
  if (with_room) noise.findings = world.with_room->noise;
  CausesFound causes = judged.names_causes() ? causes_of(nominal, found) : CausesFound{};
  for (std::size_t k = 0; k < member_gains.size() && k < causes.causes.size(); ++k)
    causes.causes[k].held_out_gain = member_gains[k];
  Located place =
      located(nominal, found, judged, causes.causes, test.timeline, covariates, options.signals);

  // A cause moves parameters: they are looked at with it in the model.
  const search::Fitted& in_the_model = best && alarm ? best->after : nominal;
  auto beyond = world.instead ? world.instead
                              : beyond_prior(nominal_filter, in_the_model, options.search.alpha);
  if (beyond) beyond->taken = world.wrong_priors;

  if (judged.verdict == Verdict::unexplained && !(beyond && beyond->explains) &&
      options.proposing != Proposing::left_out) {
    stages.begin("forms", 0.0);
    d.proposal = proposal::propose(found, noise_without_effect(nominal, found), test,
                                   options.search.alpha, {options.folds, recording_ends, {}});
    if (d.proposal) move_to(place, *d.proposal);
  }
  d.profiles = profiled(found, test, causes.causes, options, stages);
  set_intervals(causes.causes, d.profiles, as_believed);
  stages.begin("starts", 0.07);
  d.fit.start_spread_before = d.fit.start_spread_after = fitted.start_spread;
  if (best && !starts.empty())
    d.fit.start_spread_after = patched_spread(as_believed, test, starts, *best);
  stages.end();

  d.verdict = judged.verdict;
  d.p_value = found.p_value;
  if (judged.one_gyro)
    d.p_value =
        std::min(d.p_value, NoiseLimits::one_gyro_tries * std::exp(-0.5 * judged.one_gyro->gain));
  if (judged.of_no_noise) d.p_value = std::min(d.p_value, *judged.of_no_noise);
  d.where = std::move(place.where);
  d.signals = std::move(place.signals);
  d.causes = std::move(causes.causes);
  d.cosines = std::move(causes.cosines);
  d.inseparable = std::move(causes.inseparable);
  d.candidates = candidate_table(nominal, found);
  d.noise = std::move(noise.findings);
  d.driving_noise = noise.driving;
  d.other_equation_gain = other_equation_gain(found, judged, test);
  d.not_examined = not_examined(nominal, d.causes, test.timeline);
  d.probabilities = probabilities(found, posterior, world.other_way, d.noise);
  if (judged.of_no_noise)  // all of them take the noise for known
    d.probabilities = {nan_value, nan_value, nan_value, {}, nan_value, nan_value};
  d.nominal = nominal_filter;
  d.patched = best && alarm
                  ? started_where_found(with_room_for_causes(best->filter, d.causes), d.causes)
              : with_room ? world.with_room->filter
                          : as_believed;
  d.has_patch = best != nullptr && alarm;
  append(d.remarks, std::move(noise.remarks));
  append(d.remarks, judged.remarks);
  append(d.remarks, judged.one_gyro);
  append(d.remarks, judged.likelier_missing);
  if (best && alarm) append(d.remarks, left_not_white(d.fit.whiteness));
  append(d.remarks, std::move(causes.remarks));
  if (d.verdict == Verdict::unexplained) d.nearest_known = nearest_known(nominal, found);
  if (d.nearest_known) append(d.remarks, strongest_left(nominal, found));
  if (!judged.names_causes()) append(d.remarks, noise_or_effect(nominal));
  append(d.remarks, beyond);
  append(d.remarks, world.other);
  const std::span<const search::Refit> sets(found.sets);
  append(d.remarks, memory_off(in_the_model, alarm ? sets : sets.first(0), test.timeline));
  append(d.remarks, equation_against_other(d));
  return d;
}

Diagnosis diagnose(const mc::Study& study, const std::vector<Recording>& recordings,
                   const DiagnoseOptions& options) {
  if (study.filters.empty())
    throw InputError(ExitCode::config,
                     fmt::format("{}: no [[filter]]: nothing to compare the recording with. Add a "
                                 "section [[filter]] with name and coupling",
                                 study.path));
  const FilterSpec& filter = study.filters.front();
  const preparation::RecordedTest test = preparation::recorded_test(study, recordings);
  std::vector<Theta> starts;
  for (int k = 0; k + 1 < options.starts; ++k) {
    FilterSpec drawn = filter;
    drawn.starts.clear();
    starts.push_back(initial_estimate(drawn, study.monte_carlo.seed, static_cast<std::size_t>(k)));
  }
  Diagnosis d = diagnose(filter, {test.timeline, study.readout, test.measured}, starts,
                         preparation::covariates_of(recordings), options, test.ends);
  if (test.field == preparation::FieldKnown::assumed)
    d.remarks.emplace_back(remark::FieldAssumed{preparation::dipole_field_l(study.site.latitude)});
  return d;
}

}  // namespace drift::diagnosis
