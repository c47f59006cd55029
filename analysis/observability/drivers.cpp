#include "analysis/observability/drivers.hpp"

#include <algorithm>
#include <cmath>

#include "core/physics/stochastic.hpp"

namespace drift::observability {
namespace {

VecX sigmas(const LinearisedPlan& plan, double attitude_weight = 1.0) {
  return posterior_of(plan, attitude_weight).sigma;
}

/// With half of all that drives the platform at random.
RankedModel half_driven(RankedModel model) {
  model.spec.noise.angle_random_walk *= 0.5;
  model.spec.noise.drift_random_walk *= 0.5;
  for (const std::size_t size : {TermLibrary::index("q_x"), TermLibrary::index("B_x")})
    for (std::size_t axis = 0; axis < 3; ++axis)
      model.nominal[static_cast<Eigen::Index>(size + axis)] *= 0.5;
  return model;
}

}  // namespace

Drivers drivers_of(const LinearisedPlan& plan, const TestPlan& test, const RankedModel& model) {
  const MatX P = posterior_of(whole_root(plan)).covariance();
  // Of what is known at the end with what the test began with.
  const MatX C = by_the_beginning(plan.bins.back().walked, P.rows()) * P;
  const VecX before = sigmas(plan);
  Drivers out;
  out.attitude = sigmas(plan, 2.0).cwiseQuotient(before);
  const auto with_half = [&](double Readout::*noise) -> VecX {
    RankedModel better = model;
    better.readout.*noise *= 0.5;
    return sigmas(linearise(test, better)).cwiseQuotient(before);
  };
  const VecX same = VecX::Ones(before.size());
  out.accelerometers =
      model.readout.accelerometers ? with_half(&Readout::accelerometer_noise) : same;
  out.gimbals = model.readout.gimbals ? with_half(&Readout::gimbal_noise) : same;
  out.process_noise = has_process_noise(model.spec)
                          ? sigmas(linearise(test, half_driven(model))).cwiseQuotient(before)
                          : same;
  // Half the sigma is four times the information: three units more on one scaled parameter. The
  // inverse of a matrix changed by one column (Sherman and Morrison 1950).
  constexpr double more = 3.0;
  out.priors.resize(P.rows(), P.cols());
  for (Eigen::Index j = 0; j < P.cols(); ++j)
    for (Eigen::Index k = 0; k < P.rows(); ++k)
      out.priors(k, j) = std::sqrt(
          std::max(0.0, 1.0 - more * std::pow(C(k, j) / before[k], 2) / (1.0 + more * P(j, j))));
  return out;
}

}  // namespace drift::observability
