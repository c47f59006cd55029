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

/// What a fit says where its noise drives the platform: the batch fit itself knows no drift that
/// varies.
EstimateResult under_its_noise(const search::Fitted& f) {
  EstimateResult out = f.fit.estimate;
  if (!f.noise.model.driven()) return out;
  const Layout layout = make_layout(f.filter);
  const inference::Projector::Fit fit = f.projector->fit();
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    ParameterEstimate& p = out.parameters[k];
    p.value = layout.mean[i] + layout.sigma[i] * fit.x[i];
    p.sigma = layout.sigma[i] * std::sqrt(fit.covariance(i, i));
  }
  return out;
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

}  // namespace

std::optional<remark::BeyondPrior> beyond_prior(const FilterSpec& nominal,
                                                const search::Fitted& fit, double alpha) {
  remark::BeyondPrior out = far_from(nominal, under_its_noise(fit), alpha);
  return out.parameters.empty() ? std::nullopt : std::optional(std::move(out));
}

std::optional<WrongPriors> wrong_priors(const FilterSpec& nominal, const MeasuredTest& test,
                                        const BatchResult& fit,
                                        const search::SearchOptions& options) {
  constexpr int passes = 8;        // a prior holds back what is far from it: each gives more room
  constexpr double settled = 1.1;  // times the width of the pass before
  FilterSpec wide = nominal;
  BatchResult at = fit;
  remark::BeyondPrior out;
  std::size_t widened = 0;  // parameters, in the pass before
  for (int pass = 0; pass < passes; ++pass) {
    out = far_from(nominal, at.estimate, options.alpha);
    if (out.parameters.empty()) return std::nullopt;
    FilterSpec wider = nominal;
    bool same = out.parameters.size() == std::exchange(widened, out.parameters.size());
    for (const remark::BeyondPrior::Parameter& p : out.parameters) {
      const double width = p.sigmas * p.estimate.prior_sigma;
      wider.priors[p.estimate.param] = normal(p.estimate.prior_mean, width);
      same = same && width < settled * wide.priors[p.estimate.param].sigma();
    }
    if (same) break;
    wide = wider;
    at = fit_batch_from(wide, test, theta_of(wide, at), at.psi0_l);
  }
  const search::Detection left = search::detect(search::examine(wide, test, at), test, options);
  if (left.significant) return std::nullopt;
  out.explains = true;
  const double rarity =
      static_cast<double>(out.parameters.size()) * std::log(inference::SiteLimits::another);
  const double evidence = search::by_noise(left, search::declared_noise(wide)).either();
  return WrongPriors{std::move(out), rarity + evidence};
}

}  // namespace drift::diagnosis
