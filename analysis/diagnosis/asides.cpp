#include "analysis/diagnosis/asides.hpp"

#include <algorithm>

#include "analysis/identification/memory_doubt.hpp"
#include "analysis/inference/thresholds.hpp"
#include "core/stats/normal.hpp"

namespace drift::diagnosis {
namespace {

using inference::RemarkLimits;

double chi2_per_dof(const search::Fitted& e) {
  return e.fit.estimate.statistic /
         static_cast<double>(std::max<std::size_t>(1, e.fit.estimate.measured));
}

/// The rejected explanation that fits best.
const search::Refit& best_rejected(const search::Search& found) {
  return *std::ranges::min_element(found.rejected, {},
                                   [](const search::Refit& r) { return chi2_per_dof(r.after); });
}

using Why = NotExamined::Why;

/// Whether what a term does hangs on the specific force.
bool feels_force(const TermInfo& term) {
  TermMask mask;
  mask.set(*TermLibrary::find_term(term.key));
  Theta theta = Theta::Zero();
  for (std::size_t i = term.first; i < term.first + term.count; ++i) {
    const Prior prior = TermLibrary::specs[i].prior_si();
    theta[i] = prior.mean() + prior.sigma();
  }
  const std::vector<double> memory(TermLibrary::num_memory + 1, 0.5);
  const Mounting mounting;
  Surroundings<double> around{
      {5000.0, 1000.0, false, 0.3, Vec3(5e-5, 0.0, 5e-5), covariates_of_a_scene(), {}},
      Mat3::Identity(),
      Vec3(0.5, -0.4, 1.1),
      memory.data()};
  const auto added = [&](const Vec3& f_p) {
    const Inputs<double> in{&mounting, f_p, Vec3(3e-5, -5e-5, 4e-5), Vec3::Zero(), &around};
    RateAssembly<double> rates;
    ReadoutAssembly<double> readout{Vec3::Zero()};
    TermLibrary::rates(mask, in, theta.data(), rates);
    TermLibrary::readout(mask, in, theta.data(), readout);
    Vec3 sum = rates.omega_drift_g + rates.omega_torque_g + rates.omega_ip_p + readout.acc;
    return sum;
  };
  return added(Vec3(0.48, -0.36, 0.80)) != added(Vec3(-0.60, 0.64, 0.48));
}

/// Whether a term's trace in time is the clock's, on instruments of the same kind: what the other
/// follows may have moved in the same way. What grows with the specific force in one must do so in
/// the other.
bool by_the_clock(const TermInfo& cause, const TermInfo& unseen) {
  return cause.needs.clock && cause.subsystem == unseen.subsystem &&
         cause.in_rates == unseen.in_rates && cause.in_readout == unseen.in_readout &&
         feels_force(cause) == feels_force(unseen);
}

std::vector<NamedEffect> twins_of(const TermInfo& unseen,
                                  const std::vector<search::Cause>& causes) {
  std::vector<NamedEffect> twins;
  for (const search::Cause& c : causes)
    if (by_the_clock(TermLibrary::terms[*TermLibrary::find_term(c.term)], unseen))
      twins.push_back({c.term, c.axis, search::keyed(c.term, c.axis)});
  return twins;
}

}  // namespace

std::optional<NearestKnown> nearest_known(const search::Fitted& nominal,
                                          const search::Search& found) {
  if (found.rejected.empty()) return std::nullopt;
  const search::Refit& best = best_rejected(found);
  const double before = chi2_per_dof(nominal), after = chi2_per_dof(best.after);
  const double excess = before > 1.0 ? (before - std::max(1.0, after)) / (before - 1.0) : 0.0;
  if (excess < RemarkLimits::nearest) return std::nullopt;
  NearestKnown out{{}, before, after};
  for (const search::Choice& choice : best.choices) {
    const inference::Candidate& c = nominal.set.candidates[choice.candidate];
    out.effects.push_back({c.term, c.axis, c.label});
  }
  return out;
}

std::optional<remark::StrongestLeft> strongest_left(const search::Fitted& nominal,
                                                    const search::Search& found) {
  const search::Refit& best = best_rejected(found);
  const std::size_t k = best.remainder.strongest;
  if (k >= best.after.set.candidates.size() ||
      !(best.remainder.library > found.thresholds.library_threshold))
    return std::nullopt;
  remark::StrongestLeft out{{}, best.after.set.candidates[k].label};
  for (const search::Choice& choice : best.choices)
    out.labels.push_back(nominal.set.candidates[choice.candidate].label);
  return out;
}

std::optional<remark::LeftNotWhite> left_not_white(const Whiteness& w) {
  if (!(w.ljung_box_p_after < inference::RemarkLimits::whiteness_p)) return std::nullopt;
  return remark::LeftNotWhite{w.ljung_box_p_before, w.ljung_box_p_after};
}

std::optional<remark::MemoryOff> memory_off(const search::Fitted& fit,
                                            std::span<const search::Refit> alternatives,
                                            const Timeline& timeline) {
  remark::MemoryOff out{identification::memory_doubt(fit.filter, fit.fit, timeline),
                        identification::memory_gaps(fit.filter, fit.fit, timeline)};
  const auto told = [&](const identification::MemoryGaps& gaps) {
    return std::ranges::any_of(out.gaps, [&](const identification::MemoryGaps& other) {
      return other.widest.term == gaps.widest.term;
    });
  };
  for (const search::Refit& r : alternatives)
    for (const auto& gaps : identification::memory_gaps(r.after.filter, r.after.fit, timeline))
      if (!told(gaps)) out.gaps.push_back(gaps);
  const bool any = !out.terms.empty() || !out.gaps.empty();
  return any ? std::optional(std::move(out)) : std::nullopt;
}

std::optional<remark::OtherEquation> equation_against_other(const Diagnosis& d) {
  const bool closure_is_a_cause =
      std::ranges::any_of(d.causes, [](const search::Cause& c) { return c.term == closure_term; });
  if (!std::isfinite(d.other_equation_gain) || closure_is_a_cause) return std::nullopt;
  return remark::OtherEquation{d.nominal.coupling, d.other_equation_gain, !d.causes.empty()};
}

std::vector<NotExamined> not_examined(const search::Fitted& nominal,
                                      const std::vector<search::Cause>& causes,
                                      const Timeline& timeline) {
  std::vector<NotExamined> out;
  for (const std::size_t t : nominal.set.without_covariate) {
    const TermInfo& term = TermLibrary::terms[t];
    const CovariateSet missing = term.needs.covariates & ~timeline.carried;
    const Why why = term.wants_swing ? Why::no_swing
                    : missing != 0   ? Why::no_covariate
                                     : Why::no_turns;
    out.push_back({std::string(term.key),
                   why,
                   why == Why::no_swing ? std::vector<NamedEffect>{} : twins_of(term, causes),
                   {},
                   missing,
                   timeline.lacking(missing)});
  }
  for (const TermInfo& term : TermLibrary::terms) {
    if (term.key == closure_term) continue;  // judged by the jump to the other equation
    bool tried = false, seen = false;
    for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k)
      if (nominal.set.candidates[k].term == term.key) {
        tried = true;
        seen = seen || nominal.scores[k].dof > 0;
      }
    if (tried && !seen) out.push_back({std::string(term.key), Why::beyond_reach, {}, {}});
  }
  return out;
}

bool remark::OtherEquation::open() const {
  return gain >= -RemarkLimits::equation;
}

}  // namespace drift::diagnosis
