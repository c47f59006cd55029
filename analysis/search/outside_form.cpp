#include "analysis/search/outside_form.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/forms/screen.hpp"
#include "analysis/inference/size_prior.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/by_noise.hpp"
#include "analysis/search/scores/log_sum.hpp"
#include "core/base/decompose.hpp"

namespace drift::search {
namespace {

using forms::ScreenedForm;
using inference::TraceLimits;

/// Explanations are fitted through the full dynamics, forms are not: their evidence may be too
/// large by as much as linearisation is wrong by.
double log_weight_of_form(const ScreenedForm& f) {
  return f.form.log_prior + inference::log_evidence_of_unknown_size(f.T, f.dof) -
         inference::WeighLimits::not_linear * 0.5 * f.T;
}

/// Whether the test cannot tell a form from as many parameters of the library, whatever their size:
/// then it is they, and as large as they are found to be.
bool is_of_library(const ScreenedForm& form, const Fitted& nominal, const MeasuredTest& test) {
  const auto scan = nominal.projector->scan(
      forms::trace_of(form, nominal.problem, test.timeline, forms::Reach::attitude), 0);
  const double most = TraceLimits::form_told_by * TraceLimits::form_told_by / form.T;
  for (const inference::Candidate& c : nominal.set.candidates) {
    if (c.params.size() > static_cast<std::size_t>(form.dof)) continue;
    for (const inference::Variant& v : c.variants) {
      const MatX C = nominal.projected.C(v.columns, v.columns);
      const VecX x = scan.cross(0, v.columns).transpose();
      if (!(C.diagonal().minCoeff() > 0.0)) continue;
      const double alike = x.dot(solve_symmetric(C, x)) / scan.C(0, 0);
      if (inference::same_trace_of_unlike(1.0 - alike) || 1.0 - alike < most) return true;
    }
  }
  return false;
}

/// Beside the nominal model, under a noise.
double log_evidence_of_forms(const Fitted& nominal, const MeasuredTest& test,
                             const inference::NoiseModel& noise) {
  constexpr double far_behind = 10.0;  // [log] of the sum no matter
  const inference::Projector projector(nominal.problem.bare(), noise);
  std::vector<ScreenedForm> all =
      forms::screen_forms(nominal.problem, test.timeline, projector,
                          std::numeric_limits<std::size_t>::max(), forms::Reach::attitude)
          .best;
  std::ranges::stable_sort(all, std::greater{}, log_weight_of_form);
  double sum = never;
  for (const ScreenedForm& f : all) {
    if (log_weight_of_form(f) < sum - far_behind) break;
    if (!is_of_library(f, nominal, test)) sum = log_sum(sum, log_weight_of_form(f));
  }
  return sum + 0.5 * projector.marginal().log_likelihood2();
}

}  // namespace

double log_evidence_of_a_form(const Search& found, const MeasuredTest& test) {
  const inference::NoiseModel declared = declared_noise(found.nominal.filter);
  const double sum = std::log(inference::NoisePrior::as_declared) +
                     log_evidence_of_forms(found.nominal, test, declared);
  const Fitted& best = found.sets.front().after;
  if (const ByNoise noise = by_noise(best, declared); noise.declared > noise.estimated) return sum;
  return log_sum(
      sum, best.noise.log_price + log_evidence_of_forms(found.nominal, test, best.noise.model));
}

}  // namespace drift::search
