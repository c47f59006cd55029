#include "analysis/strapdown/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/strapdown/sums.hpp"

namespace drift::strapdown {
namespace {

/// Another parameter that the recording hardly tells from number k; none where there is none.
struct OneWith {
  std::size_t other = 0;
  double correlation = 0.0;
};
OneWith one_with(const EstimateResult& estimate, std::size_t k) {
  OneWith best;
  const auto row = static_cast<Eigen::Index>(k);
  for (std::size_t j = 0; j < estimate.parameters.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const double c = estimate.covariance(row, column) /
                     std::sqrt(estimate.covariance(row, row) * estimate.covariance(column, column));
    if (j != k && std::abs(c) > std::abs(best.correlation)) best = {j, c};
  }
  return best;
}

std::string key_of_param(std::size_t param) {
  return std::string(TermLibrary::specs[param].key.view());
}

/// Whether the model has something that follows the temperature.
bool follows_temperature(const EstimateResult& e) {
  return std::ranges::any_of(TermLibrary::terms, [&](const TermInfo& term) {
    if (!(term.needs.covariates & covariate("temperature").set())) return false;
    return std::ranges::any_of(e.parameters, [&](const ParameterEstimate& p) {
      return p.param >= term.first && p.param < term.first + term.count;
    });
  });
}

/// What no recording shows whose gyros do not see the Earth.
std::vector<Unobservable> hidden_with_the_earth() {
  return {{"isotropic g-sensitivity (common part of D_I_x, D_I_y, D_I_z)",
           "it turns the computed platform about the vertical, which moves no gravity in the "
           "turns, and in dwells it is one with the vertical part of Earth rate"},
          {"Earth rate",
           "its horizontal part has an unknown azimuth in every dwell and its vertical part looks "
           "like isotropic g-sensitivity; the gyros do not resolve it against their drift"},
          {"azimuth", "gravity says nothing of a turn about the vertical"},
          {"lambda (weight of eq. (6))",
           "case motion shows (1 - lambda) E, and E is not known from elsewhere"},
          {"dP_x, dO_x, dP_y",
           "a common turn of all accelerometer axes leaves |f| = 1 g: these three define the case "
           "axes"}};
}

}  // namespace

bool is_input_axis_drift(std::size_t param) {
  return TermLibrary::specs[param].group.view() == "D_I";
}

EstimateResult without_common_drift(EstimateResult e) {
  std::vector<std::size_t> of_input_axis;
  for (std::size_t k = 0; k < e.parameters.size(); ++k)
    if (is_input_axis_drift(e.parameters[k].param)) of_input_axis.push_back(k);
  if (of_input_axis.size() < 3) return e;
  const auto n = static_cast<Eigen::Index>(e.parameters.size());
  MatX P = MatX::Identity(n, n);
  double mean = 0.0;
  for (const std::size_t i : of_input_axis) {
    mean += e.parameters[i].value / 3.0;
    for (const std::size_t j : of_input_axis)
      P(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) -=
          e.parameters[j].prior_sigma / e.parameters[i].prior_sigma / 3.0;
  }
  e.covariance = (P * e.covariance * P.transpose()).eval();
  for (const std::size_t i : of_input_axis) {
    const auto row = static_cast<Eigen::Index>(i);
    e.parameters[i].value -= mean;
    e.parameters[i].sigma = e.parameters[i].prior_sigma * std::sqrt(e.covariance(row, row));
  }
  return e;
}

Findings findings_of(const EstimateResult& sensed, EarthRate earth) {
  constexpr double hardly_told_apart = 0.9;  // 19 % of the variance is left when the other is known
  const EstimateResult e =
      earth == EarthRate::hidden ? without_common_drift(sensed) : EstimateResult(sensed);
  const bool all_of_drift = e.find(TermLibrary::index("D_I_x")) != nullptr &&
                            e.find(TermLibrary::index("D_I_y")) != nullptr &&
                            e.find(TermLibrary::index("D_I_z")) != nullptr;
  Findings out;
  if (earth == EarthRate::hidden) out.unobservable = hidden_with_the_earth();
  if (earth == EarthRate::hidden && !follows_temperature(e))
    out.unobservable.push_back(
        {"temperature sensitivity",
         "nothing in the model follows the temperature: what goes with it is part of D_F"});
  for (std::size_t k = 0; k < e.parameters.size(); ++k) {
    const ParameterEstimate& p = e.parameters[k];
    const ParamSpec& spec = TermLibrary::specs[p.param];
    const OneWith twin = one_with(e, k);
    const bool one = std::abs(twin.correlation) > hardly_told_apart;
    const std::string other = key_of_param(e.parameters[twin.other].param);
    std::string with =
        one ? fmt::format("correlation {:+.3f} with {}", twin.correlation, other) : "";
    if (earth == EarthRate::hidden && all_of_drift && is_input_axis_drift(p.param))
      with = "less the mean of the three";
    if (p.learning_ratio() > learned_ratio)
      out.unobservable.push_back(
          {key_of_param(p.param), one ? fmt::format("here it is one with {} ({})", other, with)
                                      : "this recording says little of it beyond its prior"});
    else
      out.parameters.push_back({key_of_param(p.param), p.value / spec.unit.to_si,
                                p.sigma / spec.unit.to_si, std::string(spec.unit.symbol.view()),
                                with});
  }
  for (StrapdownParameter& sum : known_sums(e)) out.parameters.push_back(std::move(sum));
  return out;
}

}  // namespace drift::strapdown
