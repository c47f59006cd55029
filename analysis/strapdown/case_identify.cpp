#include "analysis/strapdown/case_identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/strapdown/sums.hpp"
#include "core/base/check.hpp"
#include "core/base/nan.hpp"
#include "mc/task/campaign.hpp"

namespace drift::strapdown {
namespace {

constexpr int most_parts = 6;

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

/// Says every parameter: with its number, or why there is none.
void say_parameters(CaseFit& out) {
  constexpr double hardly_told_apart = 0.9;  // 19 % of the variance is left when the other is known
  const EstimateResult& e = out.fit.estimate;
  for (std::size_t k = 0; k < e.parameters.size(); ++k) {
    const ParameterEstimate& p = e.parameters[k];
    const ParamSpec& spec = TermLibrary::specs[p.param];
    const Sensed s = as_sensed(p.param, p.value, p.sigma);
    const OneWith twin = one_with(e, k);
    const bool one = std::abs(twin.correlation) > hardly_told_apart;
    const std::string with = one ? fmt::format("correlation {:+.3f} with {}", twin.correlation,
                                               key_of_param(e.parameters[twin.other].param))
                                 : "";
    if (p.learning_ratio() > learned_ratio)
      out.unobservable.push_back(
          {key_of_param(p.param),
           one ? fmt::format("here it is one with {} ({})",
                             key_of_param(e.parameters[twin.other].param), with)
               : "this recording says little of it beyond its prior"});
    else
      out.parameters.push_back({key_of_param(p.param), s.value / spec.unit.to_si,
                                s.sigma / spec.unit.to_si, std::string(spec.unit.symbol.view()),
                                with});
  }
  for (StrapdownParameter& sum : known_sums(e)) out.parameters.push_back(std::move(sum));
}

BatchResult fitted(const FilterSpec& filter, const CaseStudy& of, const Measurements& measured,
                   const Theta& start) {
  return fit_batch(filter, {of.test.timeline, of.test.readout, measured}, start);
}

/// The test without what was measured in some dwells.
Measurements without_dwells(const CaseTest& test, const std::vector<bool>& left_out) {
  Measurements m = test.measured;
  for (std::size_t i = 0; i < test.timeline.intervals.size(); ++i)
    if (left_out[static_cast<std::size_t>(test.timeline.intervals[i].position)]) {
      m.acc.col(static_cast<Eigen::Index>(i)).setConstant(nan_value);
      m.gimbal.col(static_cast<Eigen::Index>(i)).setConstant(nan_value);
    }
  return m;
}

/// Without those of dwells that are no rest.
std::vector<double> known(const std::vector<double>& errors) {
  std::vector<double> all;
  std::ranges::copy_if(errors, std::back_inserter(all), [](double e) { return std::isfinite(e); });
  return all;
}

/// Errors in dwells, and on the ways that begin in them, that were left out of the fit. found: with
/// them.
CaseErrors held_out(const FilterSpec& filter, const CaseStudy& of, int parts, const Theta& found) {
  const std::size_t dwells = of.search.dwells.size();
  std::vector<int> part(dwells);
  for (std::size_t d = 0; d < dwells; ++d) part[d] = static_cast<int>(d) % parts;
  const auto of_parts = mc::run_campaign(static_cast<std::size_t>(parts), [&](std::size_t k) {
    std::vector<bool> left_out(dwells);
    for (std::size_t d = 0; d < dwells; ++d) left_out[d] = part[d] == static_cast<int>(k);
    const BatchResult fit = fitted(filter, of, without_dwells(of.test, left_out), found);
    return case_errors(of.test, filter.model(), theta_of(filter, fit), fit.psi0_l);
  });
  CaseErrors out = of_parts.front();
  for (std::size_t d = 0; d < dwells; ++d) {
    const CaseErrors& from = of_parts[static_cast<std::size_t>(part[d])];
    out.gyro[d] = from.gyro[d];
    out.gravity[d] = from.gravity[d];
  }
  for (std::size_t w = 0; w < of.test.ways.size(); ++w)
    out.up[w] = of_parts[static_cast<std::size_t>(part[of.test.ways[w] - 1])].up[w];
  return out;
}

}  // namespace

CaseIdentification identify_case(const mc::Study& study, CaseStudy of) {
  DRIFT_DEMAND(!study.filters.empty());
  CaseIdentification out;
  out.study = std::move(of);
  const std::size_t dwells = out.study.search.dwells.size();
  // With fewer the fit without a part would know little of what it predicts.
  out.folds = dwells >= most_parts ? most_parts : 0;
  for (const FilterSpec& filter : study.filters) {
    const FilterSpec seen = case_filter(filter, out.study);
    CaseFit fit;
    fit.name = filter.name;
    fit.equation = filter.coupling;
    fit.fit = fitted(seen, out.study, out.study.test.measured, start_of(seen, out.study));
    say_parameters(fit);
    if (out.folds > 0) {
      const CaseErrors in =
          case_errors(out.study.test, seen.model(), theta_of(seen, fit.fit), fit.fit.psi0_l);
      const CaseErrors held = held_out(seen, out.study, out.folds, theta_of(seen, fit.fit));
      const std::uint64_t seed = study.monte_carlo.seed;
      fit.up = score_of(in.up, held.up, unit::deg.to_si, seed);
      fit.gyro = score_of(known(in.gyro), known(held.gyro), unit::deg_per_h.to_si, seed);
      fit.gravity = score_of(in.gravity, held.gravity, 1.0, seed);
    }
    out.fits.push_back(std::move(fit));
  }
  out.eq5_gain = nan_value;
  const auto with = [&](Coupling equation) {
    return std::ranges::find(out.fits, equation, &CaseFit::equation);
  };
  const auto five = with(Coupling::eq5), six = with(Coupling::eq6);
  if (out.folds > 0 && five != out.fits.end() && six != out.fits.end())
    out.eq5_gain = paired_gain(six->up.errors, five->up.errors);
  return out;
}

}  // namespace drift::strapdown
