#include "analysis/diagnosis/causes.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/inference/thresholds.hpp"
#include "analysis/search/by_noise.hpp"
#include "analysis/search/setting_spread.hpp"
#include "core/physics/own/own_scenes.hpp"

namespace drift::diagnosis {
namespace {

using inference::TraceLimits;

/// Member `which` of an explanation: value and sigma of a parameter, in its unit. profiled: one of
/// the settings.
search::CauseParameter parameter_of(const search::Fitted& nominal, const search::Refit& r,
                                    std::size_t which, std::size_t param, bool profiled) {
  const ParamSpec& spec = TermLibrary::specs[param];
  search::CauseParameter out{std::string(spec.key.view()),         param,   0.0, 0.0,
                             std::string(spec.unit.symbol.view()), profiled};
  if (const ParameterEstimate* e = r.after.fit.estimate.find(param)) {
    out.value = e->value / spec.unit.to_si;
    const double spread = profiled && spec.continuous()
                              ? search::setting_spread(nominal, r.choices, which, param, e->value)
                              : 0.0;
    // Without a slope a fit leaves the sigma that it was given.
    const double fitted = profiled && !has_slope(param)
                              ? search::settings_apart(nominal, r.choices[which], param)
                              : e->sigma;
    out.sigma = std::max(fitted, spread) / spec.unit.to_si;
  } else {
    out.value = r.filter.priors[param].mean() / spec.unit.to_si;
  }
  if (profiled && spec.kind == ParamKind::discrete) {
    for (const double value : search::credible_settings(nominal, r.choices, which, param,
                                                        inference::SearchLimits::credible))
      out.any_of.push_back(value / spec.unit.to_si);
    if (out.any_of.size() == 1) {
      out.any_of.clear();
    } else {
      out.low_95 = out.any_of.front();
      out.high_95 = out.any_of.back();
    }
  }
  // What sets in before the test does so with it.
  if (spec.kind == ParamKind::moment) out.value = std::max(out.value, 0.0);
  out.weighed = out.value;
  out.prior_sigmas = prior_sigmas(nominal.filter, param, out.value);
  return out;
}

/// The largest distance of an amplitude from its prior's mean, in sigmas of the prior.
double size_of(const search::Fitted& nominal, const search::Refit& r,
               const std::vector<std::size_t>& params) {
  double size = 0.0;
  for (const std::size_t param : params)
    if (const ParameterEstimate* e = r.after.fit.estimate.find(param)) {
      const Prior prior = nominal.filter.believed(param);
      size = std::max(size, std::abs(e->value - prior.mean()) / prior.sigma());
    }
  return size;
}

/// Whether a setting of a candidate does anything to its columns: the electrical cycles of a
/// resolver are nothing to its eccentricity.
bool matters(const inference::Projected& p, const inference::Candidate& c, std::size_t variant,
             std::size_t setting) {
  constexpr double rounding = 1e-9;  // of the information on a column
  const inference::Variant& own = c.variants[variant];
  const auto value_in = [&](const inference::Variant& v) {
    return std::ranges::find(v.settings, setting, &std::pair<std::size_t, double>::first)->second;
  };
  bool varied = false;
  for (const inference::Variant& v : c.variants) {
    if (value_in(v) == value_in(own)) continue;
    varied = true;
    for (std::size_t k = 0; k < own.columns.size(); ++k) {
      const int a = own.columns[k], b = v.columns[k];
      if (p.C(a, a) + p.C(b, b) - 2.0 * p.C(a, b) > rounding * p.C(a, a)) return true;
    }
  }
  return !varied;
}

search::Cause cause_of(const search::Fitted& nominal, const search::Search& found, std::size_t set,
                       std::size_t which) {
  const inference::Projected& p = nominal.projected;
  const search::Refit& r = found.sets[set];
  const search::Choice& choice = r.choices[which];
  const inference::Candidate& c = nominal.set.candidates[choice.candidate];
  search::Cause cause;
  cause.term = c.term;
  cause.axis = c.axis;
  cause.set = static_cast<int>(set);
  cause.probability = found.probability[set];
  cause.log_bayes = r.log_bayes;
  const auto own = search::columns_of(nominal.set, {choice});
  const inference::Contrast contrast = inference::make_contrast(p.C, p.raw, own);
  cause.dof = contrast.dof;
  // Each of several with the others in the model: alone it may cancel against them.
  std::vector<search::Choice> others;
  for (const search::Choice& o : r.choices)
    if (o.candidate != choice.candidate) others.push_back(o);
  const auto T_of = [&](const std::vector<search::Choice>& some) {
    return inference::make_contrast(p.C, p.raw, search::columns_of(nominal.set, some)).T(p.g);
  };
  cause.T = std::max(0.0, T_of(r.choices) - (others.empty() ? 0.0 : T_of(others)));
  if (c.term == closure_term) {  // far from linear: what counts is the fit
    cause.T = std::max(cause.T, 2.0 * r.log_bayes);
    cause.dof = std::max(cause.dof, 1);
  }
  cause.p_value =
      std::min(1.0, found.thresholds.library.p_value(stats::strength(cause.T, cause.dof)) /
                        inference::SearchLimits::library_share);
  cause.size_sigma = size_of(nominal, r, c.params);
  for (const std::size_t i : c.params)
    cause.parameters.push_back(parameter_of(nominal, r, which, i, false));
  for (const auto& [i, value] : c.variants[choice.variant].settings)
    if (matters(p, c, choice.variant, i))
      cause.parameters.push_back(parameter_of(nominal, r, which, i, true));
  return cause;
}

/// What a cause could be taken for, among all candidates: the strongest cosines of other terms.
std::vector<search::Confusable> confusable_with(const search::Fitted& nominal,
                                                const search::Cause& cause,
                                                const std::vector<int>& columns) {
  const inference::Projected& p = nominal.projected;
  std::vector<search::Confusable> near;
  for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
    const inference::Candidate& c = nominal.set.candidates[k];
    // A family and its own members are one thing.
    const bool family = c.axis.empty() || cause.axis.empty();
    if (nominal.scores[k].dof == 0 || (c.term == cause.term && (c.axis == cause.axis || family)))
      continue;
    const double rho = search::cosine(p, columns, c.variants[nominal.scores[k].variant].columns);
    if (std::abs(rho) > TraceLimits::confusable) near.push_back({c.term, c.axis, rho});
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) {
    return std::abs(a.cosine) > std::abs(b.cosine);
  });
  std::vector<search::Confusable> list;
  for (const search::Confusable& c : near) {
    const auto same = [&](const search::Confusable& o) {
      return o.term == c.term && o.axis == c.axis;
    };
    if (list.size() < TraceLimits::most_confusable && std::none_of(list.begin(), list.end(), same))
      list.push_back(c);
  }
  return list;
}

/// Whether two effects are a pair already, in this order.
bool are_paired(const std::vector<Twins>& pairs, const search::Confusable& one,
                const search::Cause& other) {
  const auto is = [](const NamedEffect& e, const auto& effect) {
    return e.term == effect.term && e.axis == effect.axis;
  };
  return std::ranges::any_of(pairs,
                             [&](const Twins& t) { return is(t.one, one) && is(t.other, other); });
}

/// Whether a candidate could leave the trace that a cause of several parameters was found with: of
/// such a cause a candidate can be like one direction alone, which is no twin.
bool explains_all_of(const search::Fitted& nominal, const std::vector<int>& cause,
                     const search::Confusable& other) {
  if (cause.size() == 1) return true;
  const inference::Projected& p = nominal.projected;
  const inference::Contrast own = inference::make_contrast(p.C, p.raw, cause);
  const VecX found = own.W.transpose() * p.g(cause);  // of the trace, along orthonormal directions
  for (std::size_t k = 0; k < nominal.set.candidates.size(); ++k) {
    const inference::Candidate& c = nominal.set.candidates[k];
    if (c.term != other.term || c.axis != other.axis) continue;
    const std::vector<int>& columns = c.variants[nominal.scores[k].variant].columns;
    const inference::Contrast its = inference::make_contrast(p.C, p.raw, columns);
    const VecX seen = its.W.transpose() * (p.C(columns, cause) * (own.W * found));
    if (inference::same_trace(seen.norm() / std::max(found.norm(), 1e-300))) return true;
  }
  return false;
}

}  // namespace

double prior_sigmas(const FilterSpec& nominal, std::size_t param, double value) {
  const Prior prior = nominal.believed(param);
  return prior.sigma() > 0.0
             ? (value * TermLibrary::specs[param].unit.to_si - prior.mean()) / prior.sigma()
             : std::numeric_limits<double>::quiet_NaN();
}

CausesFound causes_of(const search::Fitted& nominal, const search::Search& found) {
  const inference::Projected& p = nominal.projected;
  CausesFound out;
  std::vector<std::vector<int>> columns;
  const auto declared = search::declared_noise(nominal.filter);
  // What the evidence of a model gains where only the declared noise is allowed to it.
  const auto as_declared = [&](const search::Fitted& f) {
    return search::by_noise(f, declared).declared - f.log_evidence();
  };
  const double as_declared_alone = found.sets.empty() ? 0.0 : as_declared(nominal);
  for (std::size_t set = 0; set < found.sets.size(); ++set) {
    const search::Refit& refit = found.sets[set];
    const double log_bayes_as_declared =
        refit.log_bayes + as_declared(refit.after) - as_declared_alone;
    for (std::size_t which = 0; which < refit.choices.size(); ++which) {
      const search::Choice& choice = refit.choices[which];
      columns.push_back(search::columns_of(nominal.set, {choice}));
      out.causes.push_back(cause_of(nominal, found, set, which));
      out.causes.back().log_bayes_as_declared = log_bayes_as_declared;
      out.causes.back().confusable_with =
          confusable_with(nominal, out.causes.back(), columns.back());
      out.cosines.labels.push_back(nominal.set.candidates[choice.candidate].label);
    }
  }
  const auto n = static_cast<Eigen::Index>(columns.size());
  out.cosines.cosine = MatX::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < n; ++k)
      if (i != k) out.cosines.cosine(i, k) = search::cosine(p, columns[i], columns[k]);
  // A candidate that is wider than the cause holds it anyway and is no twin.
  for (std::size_t k = 0; k < out.causes.size(); ++k)
    for (const search::Confusable& c : out.causes[k].confusable_with)
      if (const search::Cause& cause = out.causes[k];
          inference::same_trace(c.cosine) && (cause.axis.empty() || !c.axis.empty()) &&
          explains_all_of(nominal, columns[k], c) && !are_paired(out.inseparable, c, cause))
        out.inseparable.push_back({{cause.term, cause.axis, ""}, {c.term, c.axis, ""}});
  const search::Fitted& left = found.sets.empty() ? nominal : found.sets.front().after;
  if (const auto* period = left.leading_period()) {
    const Unit& shown = inference::unit_of(period->equation);
    out.remarks.emplace_back(remark::PeriodExplains{
        inference::equation_name(period->equation, period->axis), period->period_s,
        period->amplitude() / shown.to_si, std::string(shown.symbol.view()), period->p_value(),
        !found.sets.empty()});
  } else if (const inference::LoneEffect& lone = nominal.unknown->lone;
             found.sets.empty() && lone.p_value < inference::RemarkLimits::lone_p)
    out.remarks.emplace_back(remark::FreeInputExplains{
        lone.equation, lone.gain, lone.input.tau == inference::LoneInput::constant});
  for (const search::Cause& c : out.causes)
    if (c.term == closure_term) out.remarks.emplace_back(remark::CrosstalkMovesLambda{});
  return out;
}

}  // namespace drift::diagnosis
