#include "analysis/discovery/compare.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/discovery/chi_square.hpp"
#include "core/estimate/start_consistency.hpp"

namespace drift::discovery {
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

}  // namespace

double ljung_box_p(const LinearProblem& problem, const VecX& whitened, int lags) {
  std::map<std::pair<int, int>, std::vector<double>> series;  // channel, chain
  for (Eigen::Index k = 0; k < whitened.size(); ++k) {
    const RowTag& t = problem.tags[k];
    series[{t.channel, problem.drives[t.interval].chain}].push_back(whitened[k]);
  }
  double smallest = 1.0, count = 0.0;
  for (const auto& [key, s] : series) {
    const auto n = static_cast<double>(s.size());
    if (s.size() < static_cast<std::size_t>(4 * lags)) continue;
    double mean = 0.0, c0 = 0.0;
    for (const double v : s) mean += v / n;
    for (const double v : s) c0 += (v - mean) * (v - mean);
    double Q = 0.0;
    for (int lag = 1; lag <= lags; ++lag) {
      double c = 0.0;
      for (std::size_t k = static_cast<std::size_t>(lag); k < s.size(); ++k)
        c += (s[k] - mean) * (s[k - static_cast<std::size_t>(lag)] - mean);
      Q += c * c / (c0 * c0) / (n - lag);
    }
    Q *= n * (n + 2.0);
    smallest = std::min(smallest, std::exp(log_tail(Q, lags)));
    count += 1.0;
  }
  return std::min(1.0, smallest * std::max(count, 1.0));
}

double start_spread(const FilterSpec& filter, const Test& test, const std::vector<Theta>& starts) {
  if (starts.size() < 2) return std::nan("");
  std::vector<BatchResult> fits;
  for (const Theta& s : starts) fits.push_back(fit_batch(filter, test.timeline, test.readout, test.measured, s));
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

FitComparison compare(const Examination& nominal, const Refit* patched) {
  const Examination& after = patched ? patched->after : nominal;
  FitComparison c;
  c.dof = nominal.fit.estimate.measured;
  // Cost (data and prior) is chi-square of as many degrees as there are scalars.
  c.chi2_before = nominal.fit.estimate.statistic;
  c.chi2_after = after.fit.estimate.statistic;
  const auto n = static_cast<double>(c.dof);
  c.chi2_per_dof_before = c.chi2_before / n;
  c.chi2_per_dof_after = c.chi2_after / n;
  const double h = 2.0 / (9.0 * n);  // Wilson-Hilferty
  c.band_low = std::pow(1.0 - h - 1.96 * std::sqrt(h), 3.0);
  c.band_high = std::pow(1.0 - h + 1.96 * std::sqrt(h), 3.0);
  c.whiteness.ljung_box_p_before = ljung_box_p(nominal.problem, nominal.projector->clean_residual(), 10);
  c.whiteness.ljung_box_p_after = ljung_box_p(after.problem, after.projector->clean_residual(), 10);
  const auto per_row = [](const Examination& e) {
    return e.projector->candidates().chi2 / static_cast<double>(std::max<Eigen::Index>(1, e.projector->candidates().rows));
  };
  c.whiteness.nis_per_dof_before = per_row(nominal);
  c.whiteness.nis_per_dof_after = per_row(after);
  c.residual_before = residuals(nominal.fit);
  c.residual_after = residuals(after.fit);
  if (!patched) return c;
  c.log_likelihood_ratio = c.chi2_before - c.chi2_after;
  std::vector<int> columns;
  for (const Choice& choice : patched->choices) {
    const auto& more = nominal.set.candidates[choice.candidate].variants[choice.variant].columns;
    columns.insert(columns.end(), more.begin(), more.end());
  }
  const Projected& p = nominal.projector->candidates();
  c.linear_T = make_contrast(p.C, p.raw, columns).T(p.g);
  c.sign_agrees = patched->sign_agrees;
  c.shifted = shifts(nominal.fit, after.fit);
  return c;
}

}  // namespace drift::discovery
