#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "analysis/identification/identify.hpp"

namespace drift::test {

struct PaperValue {
  std::string_view key;
  std::vector<double> values, sigmas;  // in the parameter's unit
};

inline mc::Published published(std::string name, std::string filter,
                               const std::vector<PaperValue>& rows) {
  mc::Published p{std::move(name), std::move(filter), {}};
  for (const PaperValue& row : rows) {
    mc::Published::Value v;
    v.param = TermLibrary::find(row.key).value();
    const double unit = TermLibrary::specs[v.param].unit.to_si;
    for (const double x : row.values) v.values.push_back(x * unit);
    for (const double s : row.sigmas) v.sigmas.push_back(s * unit);
    p.values.push_back(v);
  }
  return p;
}

/// Table 1 of Fu, Shao, Deng, Control and Decision 17(3), 2002.
inline std::vector<mc::Published> table_1() {
  return {published("Table 1", "corrected",
                    {{"D_I_z", {1.51, 1.69, 1.55}, {0.03, 0.03, 0.03}},
                     {"D_S_x", {0.29, 0.44, 0.311}, {0.14, 0.13, 0.08}},
                     {"eta_x", {101.04, 85.92, 96.09}, {5.47, 6.99, 4.24}}}),
          published("Table 1", "legacy",
                    {{"D_I_z", {-1.79, -1.20, -1.35}, {0.04, 0.03, 0.03}},
                     {"D_S_x", {-0.06, 2.89, 2.21}, {0.15, 0.16, 0.12}},
                     {"eta_x", {268.15, -157.02, -8.07}, {14.98, 16.40, 27.15}}}),
          published("component test", "",
                    {{"D_I_z", {1.45}, {}}, {"D_S_x", {0.33}, {}}, {"eta_x", {112.0}, {}}})};
}

/// A study with two filters over the base terms.
inline mc::Study study() {
  mc::Study s;
  s.title = "Six-position drift test";
  s.truth.coupling = Coupling::eq5;
  for (const char* name : {"corrected", "legacy"}) {
    FilterSpec f;
    f.name = name;
    f.coupling = s.filters.empty() ? Coupling::eq5 : Coupling::eq6;
    for (const char* term :
         {"fixed_drift", "g_drift", "g2_drift", "gyro_misalignment", "accelerometer"}) {
      TermMask mask;
      mask.set(TermLibrary::find_term(term).value());
      f.active |= TermLibrary::params_of(mask);
    }
    for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
      f.priors[i] = TermLibrary::specs[i].prior_si();
    f.drawn_starts = 3;
    s.filters.push_back(f);
  }
  return s;
}

/// An estimator that ended `off` prior sigmas from the truth, with sigma a tenth of the prior's.
inline EstimateResult result(const Layout& layout, const Theta& truth, double off) {
  EstimateResult r;
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const double s = layout.sigma[k];
    r.parameters.push_back(
        {layout.params[k], 0.0, truth[layout.params[k]] + off * s, 0.1 * s, layout.mean[k], s});
  }
  r.statistic = 1010.0;
  r.measured = 1000;
  r.iterations = 5;
  return r;
}

/// Made by hand: filter 0 agrees between its starts, filter 1 is 3 prior sigmas apart.
inline identification::Identification identification(const mc::Study& s) {
  identification::Identification id;
  id.simulated = true;
  id.truth.emplace();
  for (std::size_t i = 0; i < TermLibrary::num_params; ++i)
    id.truth->theta[i] = 0.5 * TermLibrary::specs[i].prior_si().sigma();
  for (std::size_t f = 0; f < s.filters.size(); ++f) {
    identification::FilterSummary summary;
    summary.filter = f;
    summary.name = s.filters[f].name;
    summary.coupling = s.filters[f].coupling;
    summary.layout = make_layout(s.filters[f]);
    summary.agreeing_starts = 3;  // the batch fits
    const auto n = static_cast<Eigen::Index>(summary.layout.size());
    for (std::size_t k = 0; k < 3; ++k) {
      identification::FilterRun run;
      run.filter = f;
      run.start = k;
      const double off = (static_cast<double>(k) - 1.0) * (f == 0 ? 0.02 : 3.0);
      run.ekf = result(summary.layout, id.truth->theta, off);
      run.batch.estimate = result(summary.layout, id.truth->theta, 0.0);
      constexpr Eigen::Index samples = 300;
      run.history.estimate.resize(n, samples);
      run.history.sigma.resize(n, samples);
      for (Eigen::Index i = 0; i < samples; ++i) {
        const double left = std::exp(-0.02 * static_cast<double>(i));
        for (Eigen::Index j = 0; j < n; ++j) {
          const ParameterEstimate& p = run.ekf.parameters[static_cast<std::size_t>(j)];
          run.history.estimate(j, i) =
              p.value + left * p.prior_sigma * std::sin(0.1 * static_cast<double>(i));
          run.history.sigma(j, i) = p.sigma + left * p.prior_sigma;
        }
        run.history.t.push_back(60.0 * static_cast<double>(i + 1));
        run.history.nis.push_back(6.0 + 2.0 * std::sin(static_cast<double>(i * 7)));
        run.history.scalars.push_back(6);
      }
      id.runs.push_back(std::move(run));
    }
    for (const std::size_t p : summary.layout.params)
      summary.spread.push_back({p, f == 0 ? 0.2 : 30.0, 0.0});
    id.summaries.push_back(std::move(summary));
  }
  return id;
}

}  // namespace drift::test
