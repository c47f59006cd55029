#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "analysis/report/identify/results_out.hpp"
#include "analysis/report/page/table.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/nan.hpp"
#include "core/base/words.hpp"

namespace drift::report {
namespace {

/// A number behind what stands before it.
std::string cell(double value) {
  return "," + csv_number(value);
}

/// The first columns of every table.
std::string head_of(const NamedResult& r) {
  return fmt::format("{},{},{},{}", csv_field(r.summary.name), key_of(r.summary.coupling),
                     r.run.start + 1, r.estimator);
}

std::string estimates_csv(const std::vector<NamedResult>& results,
                          const identification::Identification& id) {
  std::string out =
      "filter,coupling,start,estimator,parameter,unit,estimate,sigma,started_at,prior_mean,"
      "prior_sigma,truth,status\n";
  for (const NamedResult& r : results)
    for (const ParameterEstimate& p : r.result.parameters) {
      const double unit = unit_of(p.param);
      out += fmt::format("{},{},{}", head_of(r), parameter_key(p.param), parameter_unit(p.param));
      for (const double value :
           {p.value, p.sigma, p.start, p.prior_mean, p.prior_sigma,
            id.truth ? id.truth->theta[static_cast<Eigen::Index>(p.param)] : nan_value})
        out += cell(value / unit);
      out += fmt::format(",{}\n", status_key(r.result.status));
    }
  return out;
}

std::string covariance_csv(const std::vector<NamedResult>& results) {
  std::string out(covariance_header);
  for (const NamedResult& r : results) out += covariance_rows(head_of(r), r.result);
  return out;
}

std::string residuals_csv(const identification::Identification& id) {
  std::string out = "filter,coupling,start,sample,time [s],position,phase";
  for (const char* channel : channel_names) out += fmt::format(",residual_{} [sigma]", channel);
  out += ",nis,scalars,recording\n";
  for (const identification::FilterRun& run : id.runs) {
    const identification::FilterSummary& filter = id.summaries[run.filter];
    const std::string head =
        fmt::format("{},{},{}", csv_field(filter.name), key_of(filter.coupling), run.start + 1);
    for (std::size_t i = 0; i < id.samples.size(); ++i) {
      const identification::SampleOfTest& s = id.samples[i];
      fmt::format_to(std::back_inserter(out), "{},{}{},{},{}", head, i, cell(s.t), s.position,
                     s.slew ? 1 : 0);
      for (const double residual : whitened_residuals(run, i)) out += cell(residual);
      out +=
          cell(run.history.nis[i]) + fmt::format(",{},{}\n", run.history.scalars[i], s.recording);
    }
  }
  return out;
}

}  // namespace

const char* status_key(EstimateStatus status) {
  switch (status) {
    case EstimateStatus::not_converged:
      return "not_converged";
    case EstimateStatus::diverged:
      return "diverged";
    case EstimateStatus::ok:
      break;
  }
  return "ok";
}

double covariance_of(const EstimateResult& result, std::size_t k, std::size_t l) {
  if (result.covariance.size() == 0) return nan_value;  // it failed before there was one
  const ParameterEstimate &a = result.parameters[k], &b = result.parameters[l];
  return result.covariance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) *
         (a.prior_sigma / unit_of(a.param)) * (b.prior_sigma / unit_of(b.param));
}

std::string covariance_rows(const std::string& head, const EstimateResult& result) {
  std::string out;
  const auto& parameters = result.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    for (std::size_t l = k; l < parameters.size(); ++l) {
      const double c = covariance_of(result, k, l);
      out += fmt::format(
          "{},{},{},{},{}{}{}\n", head, parameter_key(parameters[k].param),
          parameter_key(parameters[l].param), parameter_unit(parameters[k].param),
          parameter_unit(parameters[l].param), cell(c),
          cell(c / std::sqrt(covariance_of(result, k, k) * covariance_of(result, l, l))));
    }
  return out;
}

double NamedResult::covariance(std::size_t k, std::size_t l) const {
  return covariance_of(result, k, l);
}

std::vector<NamedResult> named_results(const identification::Identification& id) {
  std::vector<NamedResult> all;
  for (const identification::FilterSummary& summary : id.summaries)
    for (const identification::FilterRun* run : id.runs_of(summary.filter)) {
      all.push_back({summary, *run, "ekf", run->ekf});
      all.push_back({summary, *run, "batch", run->batch.estimate});
    }
  return all;
}

std::vector<double> whitened_residuals(const identification::FilterRun& run, std::size_t i) {
  std::vector<double> all;
  const auto column = static_cast<Eigen::Index>(i);
  for (const Mat3X* residual : {&run.batch.acc_residual, &run.batch.gimbal_residual})
    for (Eigen::Index a = 0; a < 3; ++a)
      all.push_back(column < residual->cols() ? (*residual)(a, column) : nan_value);
  return all;
}

std::vector<TextFile> result_tables(const identification::Identification& id) {
  const std::vector<NamedResult> results = named_results(id);
  return {{"estimates.csv", estimates_csv(results, id)},
          {"covariance.csv", covariance_csv(results)},
          {"residuals.csv", residuals_csv(id)}};
}

}  // namespace drift::report
