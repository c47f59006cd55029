#include "analysis/diagnosis/doubts/wrong_priors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/identification/beyond_prior.hpp"
#include "analysis/identification/common_scale.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/by_noise.hpp"
#include "core/estimate/layout.hpp"

namespace drift::diagnosis {
namespace {

/// What a fit says under a noise that drives the platform: the batch fit itself knows no drift that
/// varies.
EstimateResult told_by(const inference::Projector& projector, const FilterSpec& filter,
                       EstimateResult out) {
  const Layout layout = make_layout(filter);
  const inference::Projector::Fit fit = projector.fit();
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    ParameterEstimate& p = out.parameters[k];
    p.value = layout.mean[i] + layout.sigma[i] * fit.x[i];
    p.sigma = layout.sigma[i] * std::sqrt(fit.covariance(i, i));
  }
  return out;
}

EstimateResult under_its_noise(const search::Fitted& f) {
  if (!f.noise.model.driven()) return f.fit.estimate;
  return told_by(*f.projector, f.filter, f.fit.estimate);
}

/// The same of a fit that was not examined, its noise estimated.
EstimateResult under_its_noise(const FilterSpec& filter, const MeasuredTest& test,
                               const BatchResult& fit) {
  const inference::LinearProblem problem = inference::linear_problem(filter, test, fit, {});
  const inference::NoiseEstimate noise =
      inference::estimate_noise(problem, search::declared_noise(filter));
  if (!noise.model.driven()) return fit.estimate;
  return told_by(inference::Projector(problem, noise.model), filter, fit.estimate);
}

/// Parameters of the nominal model that an estimate has too far from its priors, whatever priors it
/// was made with. Of a cause the size is told elsewhere.
remark::BeyondPrior far_from(const FilterSpec& nominal, EstimateResult estimate, double alpha) {
  std::erase_if(estimate.parameters,
                [&](const ParameterEstimate& p) { return !nominal.active[p.param]; });
  for (ParameterEstimate& p : estimate.parameters) {
    p.prior_mean = nominal.priors[p.param].mean();
    p.prior_sigma = nominal.priors[p.param].sigma();
  }
  remark::BeyondPrior out;
  out.of = static_cast<std::size_t>(std::ranges::count_if(
      estimate.parameters, [](const ParameterEstimate& p) { return p.prior_sigma > 0.0; }));
  if (out.of == 0) return out;
  for (const auto& [param, sigmas] :
       identification::beyond_prior(estimate, identification::farthest_by_chance(out.of, alpha)))
    out.parameters.push_back(
        {*estimate.find(param), sigmas, identification::chance_of_farthest(out.of, sigmas)});
  if (!out.parameters.empty()) out.scales = identification::common_scale(estimate);
  return out;
}

/// A model with priors as wide as that.
FilterSpec with_room(FilterSpec model, const remark::BeyondPrior& beyond) {
  for (const remark::BeyondPrior::Parameter& p : beyond.parameters)
    model.priors[p.estimate.param] =
        normal(p.estimate.prior_mean, p.sigmas * p.estimate.prior_sigma);
  return model;
}

struct Widened {
  FilterSpec filter;
  BatchResult fit;
  remark::BeyondPrior beyond;
};

/// Of priors that were found wrong as if the noise were as declared, those that still are under the
/// noise that is left: what is no error of a model that has room bends parameters that are all
/// right. Nothing if none is.
std::optional<Widened> under_noise(Widened out, const FilterSpec& nominal, const FilterSpec& model,
                                   const MeasuredTest& test, double alpha) {
  while (true) {
    const std::size_t before = out.beyond.parameters.size();
    remark::BeyondPrior left = far_from(nominal, under_its_noise(out.filter, test, out.fit), alpha);
    std::erase_if(left.parameters, [&](const remark::BeyondPrior::Parameter& p) {
      return std::ranges::none_of(out.beyond.parameters, [&](const auto& of) {
        return of.estimate.param == p.estimate.param;
      });
    });
    out.beyond = std::move(left);
    if (out.beyond.parameters.empty()) return std::nullopt;
    if (out.beyond.parameters.size() == before) return out;
    out.filter = with_room(model, out.beyond);
    out.fit = fit_batch_from(out.filter, test, theta_of(out.filter, out.fit), out.fit.psi0_l);
  }
}

/// A model with priors as wide as the data take the nominal parameters from their means. Nothing if
/// none is far off. model: the nominal one, or that with causes. fit: of it.
std::optional<Widened> widened(const FilterSpec& nominal, const FilterSpec& model,
                               const MeasuredTest& test, const BatchResult& fit, double alpha) {
  constexpr int passes = 8;        // a prior holds back what is far from it: each gives more room
  constexpr double settled = 1.1;  // times the width of the pass before
  Widened out{model, fit, {}};
  std::size_t before = 0;  // parameters, in the pass before
  for (int pass = 0; pass < passes; ++pass) {
    out.beyond = far_from(nominal, out.fit.estimate, alpha);
    if (out.beyond.parameters.empty()) return std::nullopt;
    const FilterSpec wider = with_room(model, out.beyond);
    bool same = out.beyond.parameters.size() == std::exchange(before, out.beyond.parameters.size());
    for (const remark::BeyondPrior::Parameter& p : out.beyond.parameters)
      same = same && wider.priors[p.estimate.param].sigma() <
                         settled * out.filter.priors[p.estimate.param].sigma();
    if (same) break;
    out.filter = wider;
    out.fit = fit_batch_from(out.filter, test, theta_of(out.filter, out.fit), out.fit.psi0_l);
  }
  return under_noise(std::move(out), nominal, model, test, alpha);
}

/// The nominal model with room for what an effect leaves beyond its prior, where that is less than
/// without the effect.
std::optional<Widened> widened_beside(const search::Refit& effect, const FilterSpec& nominal,
                                      const MeasuredTest& test, double alpha) {
  FilterSpec model = effect.filter;
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    if (nominal.active[i]) model.priors[i] = nominal.priors[i];
  auto beside = widened(nominal, model, test, effect.after.fit, alpha);
  if (!beside) return std::nullopt;
  Widened out{with_room(nominal, beside->beyond), {}, std::move(beside->beyond)};
  out.fit = fit_batch_from(out.filter, test, theta_of(out.filter, effect.after.fit),
                           effect.after.fit.psi0_l);
  return out;
}

/// How rare such priors are.
double log_rarity(const remark::BeyondPrior& beyond) {
  return static_cast<double>(beyond.parameters.size()) * std::log(inference::SiteLimits::another);
}

/// Whether one effect of the library is all that was found, and leaves nothing.
bool is_one_effect(const FilterSpec& nominal, const search::Search& found, double alpha) {
  return !found.sets.empty() && found.sets.front().choices.size() == 1 && !found.just_not &&
         !beyond_prior(nominal, found.sets.front().after, alpha);
}

/// Whether a model with room, with one effect at the most, may come within reach of what was found;
/// linearised, one of its priors wrong.
bool within_reach(const search::Fitted& with_room, double log_total_of_right) {
  double best = 0.0;
  for (const search::Score& s : with_room.scores) best = std::max(best, s.log_bayes);
  return with_room.log_evidence() + best + std::log(inference::SiteLimits::another) >
         log_total_of_right - inference::ReachLimits::negligible;
}

search::Evidence as_rare(search::Evidence e, double log_rarity) {
  for (double* part : {&e.declared, &e.estimated, &e.outside}) *part += log_rarity;
  for (search::Evidence::Weighed& w : e.library) w.log_weight += log_rarity;
  return e;
}

}  // namespace

std::optional<remark::BeyondPrior> beyond_prior(const FilterSpec& nominal,
                                                const search::Fitted& fit, double alpha) {
  remark::BeyondPrior out = far_from(nominal, under_its_noise(fit), alpha);
  return out.parameters.empty() ? std::nullopt : std::optional(std::move(out));
}

std::optional<WrongPriors> wrong_priors(const FilterSpec& nominal, const MeasuredTest& test,
                                        const BatchResult& fit, const search::Search& right,
                                        double log_total_of_right,
                                        const search::SearchOptions& options) {
  constexpr int passes = 3;  // an effect takes some of them back, and others come to be named
  std::optional<WrongPriors> out;
  const bool one_effect = is_one_effect(nominal, right, options.alpha);
  auto wide = widened(nominal, nominal, test, fit, options.alpha);
  for (int pass = 0; wide && pass < passes; ++pass) {
    if (out && wide->beyond.parameters.size() >= out->beyond.parameters.size()) break;
    search::Fitted examined = search::examine(wide->filter, test, wide->fit);
    // Another effect and a wrong prior, in the place of one effect alone, must be seen from afar.
    if (one_effect && !within_reach(examined, log_total_of_right)) break;
    search::Search found = search::search(std::move(examined), test, options);
    search::Evidence evidence = as_rare(search::evidence_of(found), log_rarity(wide->beyond));
    if (out && search::log_total(evidence) < search::log_total(out->evidence)) break;
    out = WrongPriors{wide->beyond, wide->filter, std::move(found), std::move(evidence)};
    out->beyond.explains = !out->found.significant;
    if (out->found.sets.empty()) break;
    wide = widened_beside(out->found.sets.front(), nominal, test, options.alpha);
    if (!wide) return std::nullopt;  // the effect, where all priors are right
  }
  return out;
}

}  // namespace drift::diagnosis
