#include "analysis/search/outside_form.hpp"

#include "analysis/forms/screen.hpp"
#include "analysis/inference/thresholds.hpp"
#include "analysis/search/scores/log_sum.hpp"
#include "analysis/search/scores/size_prior.hpp"

namespace drift::search {
namespace {

/// Beside the nominal model, under a noise.
double log_evidence(const Fitted& nominal, const MeasuredTest& test,
                    const inference::NoiseModel& noise) {
  const inference::Projector projector(nominal.problem.bare(), noise);
  double sum = never;
  for (const forms::ScreenedForm& f :
       forms::screen_forms(nominal.problem, test.timeline, projector,
                           std::numeric_limits<std::size_t>::max(), forms::Reach::attitude)
           .best)
    sum = log_sum(sum, f.form.log_prior + log_evidence_of_unknown_size(f.T, f.dof));
  return sum + 0.5 * projector.marginal().log_likelihood2();
}

}  // namespace

double log_evidence_of_a_form(const Search& found, const MeasuredTest& test) {
  const inference::NoiseModel declared = declared_noise(found.nominal.filter);
  const double as_declared = std::log(inference::NoisePrior::as_declared),
               sum = as_declared + log_evidence(found.nominal, test, declared);
  const Fitted& best = found.sets.front().after;
  const double prefers_declared =
      as_declared + 0.5 * inference::marginal_of(best.problem, declared).log_likelihood2() -
      best.log_evidence();
  if (prefers_declared > 0.0) return sum;
  return log_sum(sum, best.noise.log_price + log_evidence(found.nominal, test, best.noise.model));
}

}  // namespace drift::search
