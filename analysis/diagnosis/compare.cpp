#include "analysis/diagnosis/compare.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/inference/marginal.hpp"
#include "analysis/inference/whiteness.hpp"
#include "core/estimate/start_consistency.hpp"
#include "core/physics/stochastic.hpp"
#include "core/stats/chi_square_band.hpp"

namespace drift::diagnosis {
namespace {

Eigen::Matrix<double, 6, Eigen::Dynamic> residuals(const BatchResult& fit) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> r(6, fit.acc_residual.cols());
  r << fit.acc_residual, fit.gimbal_residual;
  return r;
}

std::vector<ShiftedParameter> shifts(const BatchResult& before, const BatchResult& after) {
  std::vector<ShiftedParameter> all;
  for (const ParameterEstimate& p : before.estimate.parameters) {
    const ParameterEstimate* q = after.estimate.find(p.param);
    if (!q) continue;
    const ParamSpec& spec = TermLibrary::specs[p.param];
    ShiftedParameter s;
    s.param = p.param;
    s.key = spec.key.view();
    s.unit = spec.unit.symbol.view();
    s.before = p.value / spec.unit.to_si;
    s.sigma_before = p.sigma / spec.unit.to_si;
    s.after = q->value / spec.unit.to_si;
    s.sigma_after = q->sigma / spec.unit.to_si;
    s.shift_sigma = (q->value - p.value) / p.sigma;
    all.push_back(std::move(s));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::abs(a.shift_sigma) > std::abs(b.shift_sigma);
  });
  return all;
}

/// Cost of a fit under the noise that its filter declares; the batch fit knows none that drives the
/// drift.
double chi2_as_declared(const search::Fitted& f) {
  if (!drift_varies(f.filter)) return f.fit.estimate.statistic;
  return inference::marginal_of(f.problem, search::declared_noise(f.filter)).chi2;
}

}  // namespace

double start_spread(const std::vector<BatchResult>& fits) {
  if (fits.size() < 2) return std::nan("");
  double largest = 0.0;
  for (std::size_t k = 0; k < fits.front().estimate.parameters.size(); ++k) {
    std::vector<double> values, sigmas;
    for (const BatchResult& f : fits) {
      values.push_back(f.estimate.parameters[k].value);
      sigmas.push_back(f.estimate.parameters[k].sigma);
    }
    largest = std::max(largest, start_consistency(values, sigmas));
  }
  return largest;
}

FitComparison compare(const search::Fitted& nominal, const search::Refit* patched,
                      int whiteness_draws) {
  const search::Fitted& after = patched ? patched->after : nominal;
  FitComparison c;
  c.dof = nominal.fit.estimate.measured;
  // Cost (data and prior) is chi-square of as many degrees as there are scalars.
  c.chi2_before = chi2_as_declared(nominal);
  c.chi2_after = chi2_as_declared(after);
  const auto n = static_cast<double>(c.dof);
  c.chi2_per_dof_before = c.chi2_before / n;
  c.chi2_per_dof_after = c.chi2_after / n;
  const stats::Band band = stats::chi_square_band(n);
  c.band_low = band.low;
  c.band_high = band.high;
  // One noise for both.
  const inference::Projector before(nominal.problem, after.noise.model);
  const auto per_row = [](const inference::Projector& p) {
    return p.marginal().chi2 / static_cast<double>(std::max<Eigen::Index>(1, p.marginal().rows));
  };
  c.whiteness.nis_per_dof_before = per_row(before);
  c.whiteness.nis_per_dof_after = per_row(*after.projector);
  c.whiteness.ljung_box_p_before = c.whiteness.ljung_box_p_after = std::nan("");
  if (whiteness_draws > 0) {
    c.whiteness.ljung_box_p_before =
        inference::whiteness_p(nominal.problem, before, 10, whiteness_draws);
    c.whiteness.ljung_box_p_after =
        patched ? inference::whiteness_p(after.problem, *after.projector, 10, whiteness_draws)
                : c.whiteness.ljung_box_p_before;
  }
  c.residual_before = residuals(nominal.fit);
  c.residual_after = residuals(after.fit);
  if (!patched) return c;
  c.log_likelihood_ratio = before.marginal().chi2 - after.projector->marginal().chi2;
  const std::vector<int> columns = search::columns_of(nominal.set, patched->choices);
  const inference::Projected p = before.candidates(columns);
  std::vector<int> own(columns.size());
  std::iota(own.begin(), own.end(), 0);
  c.linear_T = inference::make_contrast(p.C, p.raw, own).T(p.g);
  c.sign_agrees = patched->sign_agrees;
  c.shifted = shifts(nominal.fit, after.fit);
  return c;
}

}  // namespace drift::diagnosis
