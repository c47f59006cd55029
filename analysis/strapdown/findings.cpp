#include "analysis/strapdown/findings.hpp"

#include <algorithm>
#include <cmath>

namespace drift::strapdown {
namespace {

bool is_input_axis_drift(std::size_t param) {
  return TermLibrary::specs[param].group.view() == "D_I";
}

/// Takes the mean of the D_I out of an estimate, covariance included: x -> P x.
Estimate without_common_part(Estimate estimate) {
  const auto n = static_cast<Eigen::Index>(estimate.params.size());
  MatX P = MatX::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (is_input_axis_drift(estimate.params[i]) && is_input_axis_drift(estimate.params[j]))
        P(i, j) -= 1.0 / 3.0;
  VecX x(n);
  for (Eigen::Index i = 0; i < n; ++i) x[i] = estimate.theta[estimate.params[i]];
  x = P * x;
  for (Eigen::Index i = 0; i < n; ++i) estimate.theta[estimate.params[i]] = x[i];
  estimate.covariance = P * estimate.covariance * P.transpose();
  return estimate;
}

std::string note_of(std::string_view group, const Model& model) {
  if (group == "D_I") return "less the mean of the three";
  if (model.drift == DriftOrder::g2_sensitive &&
      (group == "D_F" || group == "D_II" || group == "D_OO"))
    return group == "D_F" ? "with D_SS" : "less D_SS";
  if (group == "eta" || group == "xi") return "to the case axes of the accelerometers";
  if (group == "K1") return "to local g";
  return "";
}

void append(std::vector<StrapdownParameter>& all, const Estimate& estimate, const Model& model) {
  for (std::size_t i = 0; i < estimate.params.size(); ++i) {
    const ParamSpec& spec = TermLibrary::specs[estimate.params[i]];
    const auto row = static_cast<Eigen::Index>(i);
    const double variance = estimate.covariance(row, row);
    if (!std::isfinite(variance)) continue;  // said under unobservable
    all.push_back({std::string(spec.key.view()),
                   estimate.theta[estimate.params[i]] / spec.unit.to_si,
                   std::sqrt(std::max(variance, 0.0)) / spec.unit.to_si,
                   std::string(spec.unit.symbol.view()), note_of(spec.group.view(), model)});
  }
}

}  // namespace

std::vector<StrapdownParameter> parameters_of(const Final& accepted) {
  std::vector<StrapdownParameter> all;
  append(all, without_common_part(accepted.fitted.drift), accepted.model);
  append(all, accepted.fitted.turning, accepted.model);
  append(all, accepted.fitted.accelerometer, accepted.model);
  return all;
}

std::vector<Unobservable> unobservable_of(const Final& accepted) {
  std::vector<Unobservable> all{
      {"isotropic g-sensitivity (common part of D_I_x, D_I_y, D_I_z)",
       "it turns the computed platform about the vertical, which moves no gravity in the "
       "rotations, "
       "and in dwells it is one with the vertical part of Earth rate"},
      {"Earth rate",
       "its horizontal part has an unknown azimuth in every dwell and its vertical part looks like "
       "isotropic g-sensitivity; the dwells do not resolve it against their drift residual"},
      {"azimuth", "gravity says nothing of a turn about the vertical"},
      {"temperature sensitivity",
       "temperature was not varied on its own: it goes with time and is part of D_F"},
      {"lambda (weight of eq. (6))",
       "case motion shows (1 - lambda) E, and E is not known from elsewhere"},
      {"dP_x, dO_x, dP_y",
       "a common turn of all accelerometer axes leaves |f| = 1 g: these three define the case "
       "axes"}};
  if (accepted.model.drift == DriftOrder::g2_sensitive)
    all.push_back({"D_SS", "a_I^2 + a_O^2 + a_S^2 = 1 at rest: it is one with D_F, D_II, D_OO"});
  const bool claims_tilt =
      std::any_of(accepted.model.turning.begin(), accepted.model.turning.end(),
                  [](std::size_t p) { return TermLibrary::specs[p].group.view() == "eta"; });
  if (accepted.model.equation == Coupling::eq6)
    all.push_back({"eta, xi", "eq. (6) gives misalignment no part in case motion"});
  else if (!claims_tilt)
    all.push_back({"eta, xi", "held-out rotations are not predicted better with them"});
  return all;
}

}  // namespace drift::strapdown
