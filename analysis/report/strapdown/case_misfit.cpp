#include "analysis/report/strapdown/case_misfit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/identification/beyond_prior.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/identify/judgement.hpp"
#include "analysis/report/identify/latitude_words.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/words.hpp"

namespace drift::report {

using strapdown::CaseIdentification;

namespace {

const EstimateResult& first_estimate(const CaseIdentification& id) {
  return id.fits.front().fit.estimate;
}

std::string per_dof(const EstimateResult& estimate) {
  return number_text(estimate.statistic_per_dof(), 3);
}

/// Parameters that are too far from their priors for these to be right.
std::vector<identification::BeyondPrior> far_of_case(const EstimateResult& estimate) {
  if (estimate.parameters.empty()) return {};
  return identification::beyond_prior(
      estimate, identification::farthest_by_chance(estimate.parameters.size(),
                                                   inference::FitLimits::far_from_prior));
}

const identification::BeyondPrior& farthest_of(
    const std::vector<identification::BeyondPrior>& far) {
  return *std::ranges::max_element(far, {}, &identification::BeyondPrior::sigmas);
}

std::string of_priors_text(const EstimateResult& estimate) {
  const std::vector<identification::BeyondPrior> far = far_of_case(estimate);
  const bool one = far.size() == 1;
  return fmt::format(
      "Misfit of priors alone: chi-square per degree of freedom {} where noise makes 1, and {} "
      "without what priors cost. {} {}{} prior sigmas from the mean{} of {} prior{}, which {} the "
      "library's where the study gives none ({}): {}.",
      per_dof(estimate), per_dof(identification::of_data_alone(estimate)),
      one ? "1 parameter lies" : fmt::format("{} parameters lie", far.size()), one ? "" : "up to ",
      number_text(farthest_of(far).sigmas, 2), one ? "" : "s", one ? "its" : "their",
      one ? "" : "s", one ? "is" : "are", listed_up_to(keys_of_far(far), most_far_named),
      behind_far_priors);
}

/// A prior that holds the farthest parameter, as a study states it.
std::string wide_enough(const EstimateResult& estimate) {
  const ParameterEstimate& p = *estimate.find(farthest_of(far_of_case(estimate)).param);
  const double unit = unit_of(p.param);
  const std::string symbol = parameter_unit(p.param);
  return fmt::format("{} = {{ normal = [\"{} {}\", \"{} {}\"] }}", parameter_key(p.param),
                     number_text(p.prior_mean / unit), symbol,
                     number_text(std::abs(p.value - p.prior_mean) / unit, 2), symbol);
}

}  // namespace

std::optional<identification::CommonScale> gravity_off(const CaseIdentification& id) {
  if (id.latitude) return std::nullopt;
  return identification::common_scale(first_estimate(id));
}

CaseMisfit misfit_of(const CaseIdentification& id) {
  const EstimateResult& estimate = first_estimate(id);
  if (!identification::misfit(estimate)) return CaseMisfit::none;
  if (gravity_off(id) && !identification::misfit(identification::without_prior_cost(estimate)))
    return CaseMisfit::of_gravity;
  // What the data leave is judged without the priors, which say what a unit is, not how it reads.
  if (!identification::misfit(identification::of_data_alone(estimate)) &&
      !far_of_case(estimate).empty())
    return CaseMisfit::of_priors;
  return CaseMisfit::of_model;
}

std::string case_misfit_text(const CaseIdentification& id, CaseMisfit misfit) {
  const EstimateResult& estimate = first_estimate(id);
  if (misfit == CaseMisfit::of_priors) return of_priors_text(estimate);
  const std::string fits =
      fmt::format("chi-square per degree of freedom {} where noise makes 1", per_dof(estimate));
  if (misfit == CaseMisfit::of_gravity)
    return fmt::format(
        "Misfit of priors alone: {}, and {} without what the priors of K1_x, K1_y and K1_z cost, "
        "which one cause moves.",
        fits, per_dof(identification::without_prior_cost(estimate)));
  return fmt::format(
      "Misfit: {}: something is missing or wrong, and no number below is to be trusted.", fits);
}

std::string case_next(const CaseIdentification& id, CaseMisfit misfit) {
  if (id.latitude) return latitude_next(*id.latitude, "identify");
  if (gravity_off(id) && (misfit == CaseMisfit::none || misfit == CaseMisfit::of_gravity))
    return gravity_next("identify");
  if (misfit == CaseMisfit::of_priors)
    return fmt::format(
        "Next: where the unit is like that, give such parameters priors in [filter.parameters] "
        "that hold what the fit takes ({}) and identify again; driftscope diagnose says whether an "
        "effect is missing from the model.",
        wide_enough(first_estimate(id)));
  // What diagnose does for a recording that is a misfit, and for one that is none.
  return fmt::format("Next: driftscope diagnose, on the same study and recording, says {}.",
                     misfit == CaseMisfit::of_model
                         ? "what is missing, in the model or in the noise"
                         : "whether an effect is missing from the model");
}

}  // namespace drift::report
