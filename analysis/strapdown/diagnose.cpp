#include "analysis/strapdown/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "analysis/diagnosis/advice/patched_study.hpp"
#include "analysis/strapdown/nominal.hpp"
#include "analysis/strapdown/residuals.hpp"
#include "analysis/strapdown/where.hpp"
#include "core/base/check.hpp"
#include "core/base/nan.hpp"

namespace drift::strapdown {
namespace {

using namespace diagnosis;
using namespace inference;
using namespace search;

/// The gain of a trial in standard errors: the best of its kinds if it is accepted, the worst if a
/// loss is why it is rejected.
double gain_of(const Trial& t) {
  const double best = std::max(t.z_dwell, t.z_rotation), worst = std::min(t.z_dwell, t.z_rotation);
  return t.verdict == Verdict::rejected && worst < -1.0 ? worst : best;
}

std::size_t pairs_of(const Trial& t) {
  if (t.gravity) return t.gravity->count;
  return t.z_rotation > t.z_dwell && t.rotation ? t.rotation->count : t.dwell ? t.dwell->count : 0;
}

const Trial* named(const std::vector<Trial>& trials, std::string_view name,
                   std::string_view equation) {
  for (const Trial& t : trials)
    if (t.name == name && (t.equation == equation || t.equation == "any")) return &t;
  return nullptr;
}

/// Gain of the log predictive density of a step over the model it is compared with, in units of the
/// scatter of the accepted model.
double log_gain(const Trial& trial, const Trial* against, const Trial* final_trial) {
  if (against == nullptr || final_trial == nullptr) return nan_value;
  double gain = 0.0;
  const auto add = [&](const std::optional<Score>& before, const std::optional<Score>& after,
                       const std::optional<Score>& scale, double dof) {
    if (!before || !after || !scale) return;
    const double unit = std::max(scale->in_sample, 1e-12);
    for (std::size_t k = 0; k < after->errors.size(); ++k)
      gain += 0.5 * dof *
              (std::pow(before->errors[k] / unit, 2) - std::pow(after->errors[k] / unit, 2));
  };
  add(against->gravity, trial.gravity, final_trial->gravity, 1.0);
  add(against->dwell, trial.dwell, final_trial->dwell, 3.0);
  add(against->rotation, trial.rotation, final_trial->rotation, 1.0);
  return gain;
}

class Diagnoser {
 public:
  Diagnoser(const mc::Study& study, const Recording& recording, StrapdownDiagnosis& out)
      : study_(study), out_(out), d_(out.diagnosis), r_(out.result) {
    const Signals signals = signals_of(recording);
    evidence_.dwells = r_.search.dwells;
    evidence_.rotations = find_rotations(signals, evidence_.dwells).all;
    d_.nominal = study.filters.front();
    nominal_.model = nominal_model(d_.nominal);
    nominal_.name = "nominal";
    nominal_.fitted = fit(nominal_.model, evidence_, Asked::all);
  }

  void run() {
    choose_final();
    equation_ = key_of(final_->model.equation);
    candidates();
    causes();
    compare();
    say();
  }

 private:
  /// The accepted model of the nominal equation, or of eq. (5) if that beats a nominal eq. (6).
  void choose_final() {
    final_ = &r_.accepted.front();
    for (const Final& f : r_.accepted)
      if (f.model.equation == nominal_.model.equation) final_ = &f;
    if (nominal_.model.equation != Coupling::eq6 || r_.contest.empty()) return;
    const auto& contest = r_.contest.front();
    if (!(contest.z > surely_better)) return;
    for (const Final& f : r_.accepted)
      if (f.model.equation == Coupling::eq5) final_ = &f;
    Cause closure;
    closure.term = closure_term;
    closure.T = contest.z * contest.z;
    closure.p_value = family_wise(chance_of_gain(contest.z, contest.eq5.count));
    closure.probability = 1.0;
    closure.size_sigma = nan_value;
    d_.causes.push_back(closure);
    d_.remarks.emplace_back(
        remark::EquationByTurns{contest.eq5.held_out, contest.eq6.held_out, contest.z});
  }

  double family_wise(double p) const {
    return std::min(
        1.0, p * static_cast<double>(r_.accelerometer_trials.size() + r_.gyro_trials.size()));
  }

  const Trial* trial_of(const PartOfModel& part) const {
    if (part.accelerometer) return named(r_.accelerometer_trials, part.ending, "any");
    for (const Trial& t : r_.gyro_trials)
      if ((t.equation == equation_ || t.equation == "any") && t.name.ends_with(part.ending) &&
          !t.reason.starts_with("what is left out"))
        return &t;
    return nullptr;
  }

  void candidates() {
    for (const PartOfModel& part : parts_of_model()) {
      const Trial* t = trial_of(part);
      if (t == nullptr || holds(nominal_.model, part)) continue;
      CandidateScore c;
      c.term = part.term;
      c.label = part.label;
      const Trial* against = named(part.accelerometer ? r_.accelerometer_trials : r_.gyro_trials,
                                   t->against, equation_);
      c.dof = static_cast<int>(t->parameters - (against ? against->parameters : 0));
      c.absorbed = c.amplitude = c.smallest_detectable = c.size_sigma = nan_value;
      c.observable = t->verdict != Verdict::skipped;
      c.score = std::pow(std::max(0.0, gain_of(*t)), 2);
      c.p_marginal = chance_of_gain(gain_of(*t), pairs_of(*t));
      c.p_value = family_wise(c.p_marginal);
      const Trial* last = part.accelerometer ? accelerometer_final() : gyro_final();
      c.log_bayes = log_gain(*t, against, last);
      c.probability = std::isfinite(c.log_bayes) ? 1.0 / (1.0 + std::exp(-c.log_bayes)) : nan_value;
      c.adequate = t->verdict == Verdict::accepted && holds(final_->model, part);
      d_.remarks.emplace_back(
          remark::StepJudged{std::string(part.label), std::string(name_of(t->verdict)), t->reason,
                             t->z_dwell, part.accelerometer ? nan_value : t->z_rotation});
      d_.candidates.push_back(c);
    }
    std::ranges::stable_sort(d_.candidates, std::greater{}, &CandidateScore::score);
  }

  const Trial* gyro_final() const { return named(r_.gyro_trials, final_->name, equation_); }
  const Trial* accelerometer_final() const {
    const Trial* last = nullptr;
    for (const Trial& t : r_.accelerometer_trials)
      if (t.gravity && t.verdict != Verdict::rejected) last = &t;
    return last;
  }

  void causes() {
    const auto parameters = parameters_of(*final_);
    for (const PartOfModel& part : parts_of_model()) {
      if (!holds(final_->model, part) || holds(nominal_.model, part)) continue;
      // All of g_drift goes by its O and S parts: the common part of D_I is not observable.
      if (part.groups.front() == "D_I" && final_->model.drift >= DriftOrder::g_sensitive) continue;
      Cause cause;
      cause.term = part.term;
      for (const auto& p : parameters) {
        const std::size_t index = *TermLibrary::find(p.key);
        const ParamSpec& spec = TermLibrary::specs[index];
        if (std::ranges::find(part.groups, spec.group.view()) == part.groups.end()) continue;
        cause.parameters.push_back({p.key, index, p.value, p.sigma, p.unit, false});
        cause.size_sigma = std::max(cause.size_sigma,
                                    std::abs(p.value) * spec.unit.to_si / spec.prior_si().sigma());
      }
      cause.dof = static_cast<int>(cause.parameters.size());
      for (const CandidateScore& c : d_.candidates)
        if (c.label == part.label) {
          cause.T = c.score;
          cause.p_value = c.p_value;
          cause.probability = c.probability;
        }
      d_.causes.push_back(std::move(cause));
    }
    // Alone a candidate explains everything only if it is the whole difference.
    if (d_.causes.size() > 1)
      for (CandidateScore& c : d_.candidates) c.adequate = false;
    d_.verdict = d_.causes.empty() ? diagnosis::Verdict::consistent : diagnosis::Verdict::named;
    d_.has_patch = !d_.causes.empty();
    d_.patched = patched_filter(d_.nominal, d_.causes);
    if (d_.has_patch) d_.patched.coupling = final_->model.equation;
    d_.p_value = 1.0;
    for (const Cause& c : d_.causes) d_.p_value = std::min(d_.p_value, c.p_value);
    if (d_.causes.empty())
      for (const CandidateScore& c : d_.candidates) d_.p_value = std::min(d_.p_value, c.p_value);
  }

  void compare() {
    const auto before = residuals_of(nominal_.model, nominal_.fitted, evidence_);
    const auto after = residuals_of(final_->model, final_->fitted, evidence_);
    const auto scatter = scatter_of(after);
    fill_where(before, after, scatter, evidence_, nominal_.fitted.accelerometer.theta, d_);

    const Division division{std::min(r_.options.folds, static_cast<int>(evidence_.dwells.size())),
                            r_.options.repeats, r_.options.seed};
    const auto out_before = held_out_errors(nominal_.model, evidence_, Asked::all, division);
    const auto out_after = held_out_errors(final_->model, evidence_, Asked::all, division);
    const auto was = scores_of(out_before, evidence_, scatter),
               is = scores_of(out_after, evidence_, scatter);
    HeldOut& held = d_.fit.held_out;
    double chi2_before = 0.0, chi2_after = 0.0, dof = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < was.size(); ++k) {
      Fold fold;
      fold.of = Fold::Of::dwell;
      fold.number = static_cast<int>(k) + 1;
      fold.positions = {static_cast<int>(k) + 1};
      fold.chi2_before = was[k].chi2;
      fold.chi2_after = is[k].chi2;
      fold.dof = was[k].dof;
      fold.log_score_before = -0.5 * was[k].chi2;
      fold.log_score_after = -0.5 * is[k].chi2;
      chi2_before += was[k].chi2;
      chi2_after += is[k].chi2;
      dof += static_cast<double>(was[k].dof);
      held.folds.push_back(std::move(fold));
    }
    const double n = static_cast<double>(was.size());
    held.chi2_per_dof_before = chi2_before / dof;
    held.chi2_per_dof_after = chi2_after / dof;
    held.log_score_gain = held.nested_gain = 0.5 * (chi2_before - chi2_after);
    for (std::size_t k = 0; k < was.size(); ++k)
      squares += std::pow(0.5 * (was[k].chi2 - is[k].chi2) - held.log_score_gain / n, 2);
    held.log_score_gain_sigma = std::sqrt(n * squares / (n - 1.0));
    held.improves = d_.has_patch && held.log_score_gain > 0.0;
    held.method = fmt::format("refitted, {} parts, {} divisions", division.folds, division.repeats);
    kinds(out_before, out_after);
    moved();
  }

  void kinds(const Errors& before, const Errors& after) {
    const double g = r_.options.gravity;
    d_.errors = {
        {"gyro rate in dwells", "deg/s", root_mean_square(before.dwell) / unit::deg_per_s.to_si,
         root_mean_square(after.dwell) / unit::deg_per_s.to_si},
        {"up after a turn", "deg", root_mean_square(before.rotation) / unit::deg.to_si,
         root_mean_square(after.rotation) / unit::deg.to_si},
        {"gravity in dwells", "m/s^2", root_mean_square(before.gravity) * g,
         root_mean_square(after.gravity) * g}};
  }

  void moved() {
    if (!d_.has_patch) return;
    const auto before = parameters_of(nominal_), after = parameters_of(*final_);
    for (const auto& was : before)
      for (const auto& is : after)
        if (was.key == is.key)
          d_.fit.shifted.push_back({was.key, was.unit, *TermLibrary::find(was.key), was.value,
                                    was.sigma, is.value, is.sigma,
                                    (is.value - was.value) / was.sigma});
    std::ranges::stable_sort(d_.fit.shifted, std::greater{},
                             [](const ShiftedParameter& p) { return std::abs(p.shift_sigma); });
  }

  void say() {
    d_.remarks.emplace_back(remark::NoDeclaredNoise{});
    if (final_->model.drift >= DriftOrder::g_sensitive)
      d_.remarks.emplace_back(remark::CommonDriftUnseen{});
    for (const Unobservable& u : unobservable_of(*final_))
      d_.remarks.emplace_back(remark::NotObservable{u.what, u.reason});
  }

  const mc::Study& study_;
  StrapdownDiagnosis& out_;
  Diagnosis& d_;
  const StrapdownResult& r_;
  Evidence evidence_;
  Final nominal_;
  const Final* final_ = nullptr;
  std::string equation_;
};

}  // namespace

StrapdownDiagnosis diagnose_strapdown(const mc::Study& study, const Recording& recording,
                                      StrapdownOptions options) {
  if (study.filters.empty())
    throw InputError(ExitCode::config,
                     fmt::format("{}: no [[filter]]: its first is the nominal model. Add a section "
                                 "[[filter]] with name, coupling and terms",
                                 study.path));
  const auto began = std::chrono::steady_clock::now();
  StrapdownDiagnosis out;
  options.equations = {Coupling::eq5, Coupling::eq6};
  out.result = identify_strapdown(recording, options);
  Diagnoser(study, recording, out).run();
  out.diagnosis.seconds.emplace_back(
      "diagnosis", std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  return out;
}

}  // namespace drift::strapdown
