#include "analysis/diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/diagnosis/answer.hpp"
#include "analysis/diagnosis/compare.hpp"
#include "analysis/diagnosis/conclude.hpp"
#include "analysis/diagnosis/judge_members.hpp"
#include "analysis/diagnosis/locate.hpp"
#include "analysis/diagnosis/patched_study.hpp"
#include "analysis/identification/recorded_test.hpp"
#include "analysis/search/explained.hpp"
#include "core/base/check.hpp"
#include "core/estimate/starts.hpp"
#include "mc/task/campaign.hpp"

namespace drift::diagnosis {
namespace {

/// Isolated samples far from their neighbours, taken out of the measurements: a sample is compared
/// with the median of the four around it in its channel and position. Where the instrument is
/// noisier than declared (by more than the gate allows for), its own noise is the measure.
std::size_t remove_spikes(Measurements& measured, const Timeline& timeline, const Readout& readout,
                          const BatchResult& fit) {
  constexpr double gate =
      8.0;  // sigmas of the difference, noise up to 1.5 times as declared included
  constexpr double allowed = 1.5;
  constexpr int reach = 2;
  std::size_t removed = 0;
  struct Difference {
    int axis, sample;
    double size, spread;  ///< from the median around it; of those around it
  };
  const auto clean = [&](Mat3X& values, const Mat3X& residual) {
    const auto n = static_cast<int>(values.cols());
    std::vector<Difference> all;
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < n; ++i) {
        if (!std::isfinite(residual(a, i))) continue;
        std::vector<double> around;
        for (int k = std::max(0, i - reach); k <= std::min(n - 1, i + reach); ++k)
          if (k != i && std::isfinite(residual(a, k)) &&
              timeline.intervals[k].position == timeline.intervals[i].position &&
              timeline.intervals[k].slew == timeline.intervals[i].slew)
            around.push_back(residual(a, k));
        if (around.size() < 3) continue;
        std::sort(around.begin(), around.end());
        const double median = 0.5 * (around[around.size() / 2] + around[(around.size() - 1) / 2]);
        all.push_back({a, i, std::abs(residual(a, i) - median), around.back() - around.front()});
      }
    if (all.empty()) return;
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end(),
                     [](const Difference& x, const Difference& y) { return x.size < y.size; });
    constexpr double median_of_size = 0.6745 * 1.14;  // a normal against the median of four others
    const double noise = middle->size / median_of_size;
    const double limit = gate * (noise > allowed ? noise : 1.0);
    for (const Difference& d : all)
      if (d.size > limit + 2.0 * d.spread) {
        values(d.axis, d.sample) = std::nan("");
        ++removed;
      }
  };
  if (readout.accelerometers) clean(measured.acc, fit.acc_residual);
  if (readout.gimbals) clean(measured.gimbal, fit.gimbal_residual);
  return removed;
}

/// White noise as neighbouring samples differ, where the other of eq. (5) and (6) takes most of an
/// evident misfit away: what looks like noise that drives the platform is the equation then, and
/// the noise is estimated with that in the model. Empty otherwise.
std::optional<inference::NoiseEstimate> noise_beside_equation(const FilterSpec& nominal,
                                                              const inference::Test& test,
                                                              const BatchResult& fit) {
  constexpr double evident = 1.5, most = 0.8;  // chi-square per degree; part of its excess
  FilterSpec other = nominal;
  if (nominal.coupling == Coupling::eq5)
    other.coupling = Coupling::eq6;
  else if (nominal.coupling == Coupling::eq6)
    other.coupling = Coupling::eq5;
  else
    return std::nullopt;
  const auto per_dof = [](const BatchResult& f) {
    return f.estimate.statistic /
           static_cast<double>(std::max<std::size_t>(1, f.estimate.measured));
  };
  if (per_dof(fit) < evident) return std::nullopt;
  const BatchResult with_other = fit_batch(other, test.timeline, test.readout, test.measured,
                                           inference::theta_of(nominal, fit));
  if (per_dof(fit) - per_dof(with_other) < most * (per_dof(fit) - 1.0)) return std::nullopt;
  const inference::LinearProblem problem = inference::linear_problem(nominal, test, fit, {});
  return inference::noise_of_differences(problem, inference::residual_of(problem, fit));
}

const std::vector<std::string> platform_channels{
    "time",       "position",     "phase",         "acc_x",        "acc_y",
    "acc_z",      "gimbal_outer", "gimbal_middle", "gimbal_inner", "cmd_x",
    "cmd_y",      "cmd_z",        "case_heading",  "loop_eta_x",   "loop_eta_y",
    "loop_eta_z", "loop_xi_x",    "loop_xi_y",     "loop_xi_z"};

std::vector<Covariate> covariates_of(const std::vector<Recording>& recordings) {
  std::vector<Covariate> all;
  for (const Channel& c : recordings.front().channels) {
    if (std::find(platform_channels.begin(), platform_channels.end(), c.name) !=
        platform_channels.end())
      continue;
    Covariate v{c.name, {}};
    for (const Recording& r : recordings) {
      const Channel* other = r.find(c.name);
      if (other)
        v.value.insert(v.value.end(), other->values.begin(), other->values.end());
      else
        v.value.insert(v.value.end(), r.rows(), std::nan(""));
    }
    all.push_back(std::move(v));
  }
  return all;
}

}  // namespace

Diagnosis diagnose(const FilterSpec& nominal_filter, const inference::Test& given,
                   std::span<const Theta> starts, const std::vector<Covariate>& covariates,
                   const DiagnoseOptions& options, const std::vector<std::size_t>& recording_ends) {
  const mc::ThreadCount threads(options.threads);
  Diagnosis d;
  // Shares of the whole as they usually are; a diagnosis that finds nothing ends early.
  Stages stages(d.seconds, options.progress);
  stages.begin("fit", 0.04);
  d.nominal = nominal_filter;
  d.patched = nominal_filter;

  // The nominal fit, from every start; the best is kept. Gross samples are taken out of it.
  Measurements measured = given.measured;
  const inference::Test test{given.timeline, given.readout, measured};
  const auto fit_from = [&](const Theta& start) {
    return fit_batch(nominal_filter, test.timeline, test.readout, measured, start);
  };
  BatchResult fit = fit_from(make_layout(nominal_filter).theta);
  std::size_t spikes = 0;
  for (int round = 0; round < 4; ++round) {
    const std::size_t more = remove_spikes(measured, test.timeline, test.readout, fit);
    if (more == 0) break;
    spikes += more;
    fit = fit_from(inference::theta_of(nominal_filter, fit));
  }
  // Starts are of the nominal parameters; those of a cause are held at their values until the
  // others have been fitted (with them they may make a narrow bent valley), then all are free.
  const auto from_starts = [&](const FilterSpec& filter, const Theta& found) {
    return mc::run_campaign(starts.size(), [&](std::size_t k) {
      FilterSpec held = filter;
      Theta start = starts[k];
      for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
        if (!nominal_filter.active[i]) {
          start[i] = found[i];
          if (filter.active[i]) held.priors[i] = fixed(found[i]);
        }
      const BatchResult first = fit_batch(held, test.timeline, test.readout, measured, start);
      return filter.active == nominal_filter.active
                 ? first
                 : fit_batch(filter, test.timeline, test.readout, measured,
                             inference::theta_of(held, first));
    });
  };
  std::vector<BatchResult> fits = from_starts(nominal_filter, make_layout(nominal_filter).theta);
  fits.push_back(fit);
  d.fit.start_spread_before = start_spread(fits);
  for (BatchResult& other : fits)
    if (other.estimate.statistic < fit.estimate.statistic - 1e-6) fit = std::move(other);

  stages.begin("examine", 0.08);
  const auto plain = noise_beside_equation(nominal_filter, test, fit);
  search::Examination nominal =
      search::examine(nominal_filter, test, fit, plain ? &*plain : nullptr);
  stages.begin("search", 0.5);
  const search::Search found = search::search(nominal, test, options.search);
  stages.begin("held out", 0.25);

  fill_candidates(nominal, found, d);
  d.p_value = found.p_value;
  if (std::isfinite(found.other_equation)) d.other_equation_gain = found.other_equation;
  const search::Refit* best = found.sets.empty() ? nullptr : &found.sets.front();
  // With the cause in the mean, what had been taken for noise because of it is none any more.
  fill_noise(best && found.significant ? best->after : nominal, spikes, d);
  const double spread = d.fit.start_spread_before;
  d.fit = compare(nominal, best, options.whiteness_draws);
  d.fit.start_spread_before = d.fit.start_spread_after = spread;
  if (best) {
    std::vector<std::size_t> named;
    for (const search::Choice& c : best->choices) named.push_back(c.candidate);
    d.fit.held_out =
        held_out(nominal, best->after, test, named, found.nulls.library_threshold,
                 {options.folds, recording_ends,
                  [&](std::size_t done, std::size_t total) { stages.step(done, total); }});
    d.patched = best->filter;
    d.has_patch = true;
  }
  const auto member_gains = best && found.significant
                                ? judge_members(nominal, test, *best, found.nulls)
                                : std::vector<double>{};
  stages.begin("locate", 0.06);

  d.verdict = Verdict::consistent;
  if (found.significant) {
    const bool one = found.sets.size() == 1;
    const bool members =
        std::ranges::all_of(member_gains, [](double gain) { return gain >= least_held_out_gain; });
    const bool judged = !options.named_needs_held_out || d.fit.held_out.folds.empty() ||
                        (d.fit.held_out.improves && members);
    const bool nameable = !best || (best->nameable && !found.just_not);
    d.verdict = !best                       ? Verdict::unexplained
                : one && judged && nameable ? Verdict::named
                                            : Verdict::ambiguous;
    if (found.just_not)
      d.remarks.push_back(
          "With it in the model something is left that is just significant: chance, or not the "
          "whole story. It "
          "is listed, not named.");
    else if (one && !nameable)
      d.remarks.push_back(
          "Another drift equation explains it, but its weight lambda may still be the nominal one "
          "(3 sigma): it "
          "is listed, not named.");
    if (one && !judged && !members)
      d.remarks.push_back(
          "The causes fit together, but without one of them held-out positions are predicted no "
          "worse: it is "
          "not confirmed (held_out_gain of each cause in diagnosis.json).");
    else if (one && !judged)
      d.remarks.push_back(
          "The cause fits, but held-out positions are not predicted better with it. An effect that "
          "lives in one position cannot be confirmed by the others: repeat that position.");
  } else if (noise_of_one_axis(nominal, d)) {
    d.verdict = Verdict::unexplained;
  }
  if (d.verdict != Verdict::consistent) fill_causes(nominal, found, d);
  for (std::size_t k = 0; k < member_gains.size() && k < d.causes.size(); ++k)
    d.causes[k].held_out_gain = member_gains[k];
  if (d.has_patch) d.patched = started_where_found(d.patched, d.causes);
  weigh_candidates(nominal, found, d);
  // What the cause explains, by the refit: what it takes out of the residuals.
  inference::LinearProblem shown = nominal.problem;
  shown.extra.resize(shown.rows(), best ? 1 : 0);
  std::vector<std::pair<int, double>> cause;
  if (best) {
    shown.extra.col(0) = search::taken_out(nominal.problem, nominal_filter, nominal.fit,
                                           best->filter, best->after.fit);
    cause.emplace_back(0, 1.0);
  }
  std::vector<InputEstimate> inputs;
  if (options.signals && d.verdict != Verdict::consistent) {
    // Noise that was needed only because of the effect would take the signal away.
    inference::NoiseModel white = nominal.noise.model;
    if (!found.significant) {
      white = search::declared_noise(nominal_filter);
      white.acc_factor = nominal.noise.model.acc_factor;
      white.gimbal_factor = nominal.noise.model.gimbal_factor;
    }
    inputs = estimate_inputs(shown, test.timeline, inference::Projector(shown, white), 6);
  }

  // Where it is: by the best explanation there is, else by the strongest window.
  const inference::Window* window = strongest_window(nominal);
  VecX signature = VecX::Zero(nominal.problem.rows());
  if (best)
    signature = signature_of(inference::Projector(shown, nominal.noise.model), cause);
  else if (window)
    signature = signature_of(nominal.problem, test.timeline, *nominal.projector, *window);
  const std::string driven_equation = d.where.equation;
  d.where = locate(nominal, found.nulls, signature, 8);
  d.where.equation = driven_equation;
  if (d.verdict != Verdict::consistent && driven_equation.empty()) {
    if (!inputs.empty() && inputs.front().gain > 0.0)
      d.where.equation = inference::equation_name(inputs.front().equation, inputs.front().axis);
    else if (window)
      d.where.equation = inference::equation_name(window->equation, window->axis);
  }
  for (std::size_t k = 0;
       k < std::min<std::size_t>(2, inputs.size()) && d.verdict != Verdict::consistent; ++k)
    d.signals.push_back(recovered_signal(inputs[k], test.timeline, covariates, cause));
  stages.begin("starts", 0.07);
  if (best && !starts.empty()) {
    // The same starts; what is new starts where the fit has it.
    fits = from_starts(best->filter, inference::theta_of(best->filter, best->after.fit));
    fits.push_back(best->after.fit);
    d.fit.start_spread_after = start_spread(fits);
  }
  stages.end();
  d.sentence = sentence(d);
  say_partial(nominal, found, d);
  say_noise_or_effect(nominal, d);
  say_beyond_prior(nominal.fit, d);
  say_equation(d);
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
  const identification::RecordedTest test = identification::recorded_test(study, recordings);
  std::vector<Theta> starts;
  for (int k = 0; k + 1 < options.starts; ++k) {
    FilterSpec drawn = filter;
    drawn.starts.clear();
    starts.push_back(initial_estimate(drawn, study.monte_carlo.seed, static_cast<std::size_t>(k)));
  }
  return diagnose(filter, {test.timeline, study.readout, test.measured}, starts,
                  covariates_of(recordings), options, test.ends);
}

}  // namespace drift::diagnosis
