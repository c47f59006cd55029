#include <algorithm>
#include <cmath>
#include <set>

#include "analysis/report/identify/results_out.hpp"
#include "analysis/report/page/wording.hpp"
#include "core/base/atomic_file.hpp"
#include "core/base/nan.hpp"
#include "mc/export/named_axes.hpp"

namespace drift::report {
namespace {

using mc::NamedGroup;
using mc::unit_of_parameter;

/// Places along the dimensions, and arrays full of NaN over them.
struct Places {
  NamedGroup::Names filters;
  std::size_t starts = 0;
  std::vector<std::size_t> params;  ///< library indices

  explicit Places(const std::vector<NamedResult>& results) {
    std::set<std::size_t> named;
    for (const NamedResult& r : results) {
      if (std::ranges::find(filters, r.summary.name) == filters.end())
        filters.push_back(r.summary.name);
      starts = std::max(starts, r.run.start + 1);
      named.insert(r.summary.layout.params.begin(), r.summary.layout.params.end());
    }
    params.assign(named.begin(), named.end());
  }
  std::size_t filter(const std::string& name) const {
    return static_cast<std::size_t>(std::ranges::find(filters, name) - filters.begin());
  }
  std::size_t parameter(std::size_t param) const {
    return static_cast<std::size_t>(std::ranges::find(params, param) - params.begin());
  }
  std::size_t fits() const { return filters.size() * starts; }
  std::size_t fit(const std::string& name, std::size_t start) const {
    return filter(name) * starts + start;
  }
};

std::vector<double> nothing(std::size_t count) {
  return std::vector<double>(count, nan_value);
}

void put_estimates(NamedGroup& group, const Places& at, const std::vector<NamedResult>& results) {
  const std::size_t n = at.params.size(), each = at.fits() * n;
  auto estimate = nothing(2 * each), sigma = estimate, started = nothing(each),
       mean = nothing(at.filters.size() * n), prior = mean, status = nothing(2 * at.fits()),
       chi2 = status, dof = status, covariance = nothing(2 * each * n), correlation = covariance;
  for (const NamedResult& r : results) {
    const std::size_t fit = at.fit(r.summary.name, r.run.start),
                      one = (&r.result == &r.run.ekf ? 0 : at.fits()) + fit;
    status[one] = static_cast<double>(r.result.status);
    chi2[one] = r.result.statistic;
    dof[one] = static_cast<double>(r.result.measured);
    for (std::size_t k = 0; k < r.result.parameters.size(); ++k) {
      const ParameterEstimate& p = r.result.parameters[k];
      const double unit = unit_of(p.param);
      const std::size_t place = at.parameter(p.param);
      estimate[one * n + place] = p.value / unit;
      sigma[one * n + place] = p.sigma / unit;
      started[fit * n + place] = p.start / unit;
      mean[at.filter(r.summary.name) * n + place] = p.prior_mean / unit;
      prior[at.filter(r.summary.name) * n + place] = p.prior_sigma / unit;
      for (std::size_t l = 0; l < r.result.parameters.size(); ++l) {
        const std::size_t cell = (one * n + place) * n + at.parameter(r.result.parameters[l].param);
        covariance[cell] = r.covariance(k, l);
        correlation[cell] = covariance[cell] / std::sqrt(r.covariance(k, k) * r.covariance(l, l));
      }
    }
  }
  const NamedGroup::Names of_fit{"estimator", "filter", "start"},
      of_parameter{"estimator", "filter", "start", "parameter"},
      of_pair{"estimator", "filter", "start", "parameter", "parameter_2"};
  group.put("estimate", of_parameter, {unit_of_parameter, "estimate at the end"}, estimate);
  group.put("sigma", of_parameter, {unit_of_parameter, "its reported standard deviation"}, sigma);
  group.put("started_at", {"filter", "start", "parameter"},
            {unit_of_parameter, "where the estimate started"}, started);
  group.put("prior_mean", {"filter", "parameter"}, {unit_of_parameter, "mean beforehand"}, mean);
  group.put("prior_sigma", {"filter", "parameter"}, {unit_of_parameter, "1 sigma beforehand"},
            prior);
  group.put("covariance", of_pair,
            {"parameter_unit times that of parameter_2", "covariance of the estimate"}, covariance);
  group.put("correlation", of_pair, {"1", "the same over the sigmas of both"}, correlation);
  group.put("fit", of_fit, {"1", "how the fit ended: 0 ok, 1 not converged, 2 diverged"}, status);
  group.put("chi2", of_fit,
            {"1",
             "ekf: sum of the NIS; batch: minimum of the cost, which is the sum of squares of the "
             "data (residual), of the parameters about their priors and of the attitudes at each "
             "caging about theirs, each over its sigma"},
            chi2);
  group.put("dof", of_fit, {"1", "measured scalars"}, dof);
}

void put_truth(NamedGroup& group, const Places& at, const Theta& theta) {
  std::vector<double> truth;
  for (const std::size_t p : at.params)
    truth.push_back(theta[static_cast<Eigen::Index>(p)] / unit_of(p));
  group.put("truth", {"parameter"}, {unit_of_parameter, "true value at the end"}, truth);
}

/// Residuals, innovations and what the samples are.
void put_samples(NamedGroup& group, const Places& at, const identification::Identification& id) {
  constexpr std::size_t channels = std::size(channel_names);
  const std::size_t samples = id.samples.size();
  std::vector<double> time, position, phase, noise;
  for (const identification::SampleOfTest& s : id.samples) {
    time.push_back(s.t);
    position.push_back(s.position);
    phase.push_back(s.slew ? 1.0 : 0.0);
    for (std::size_t c = 0; c < channels; ++c)
      noise.push_back(c < 3 ? s.accelerometer_noise / unit::ug.to_si
                            : s.gimbal_noise / unit::arcsec.to_si);
  }
  using Type = mc::Hdf5Output::Type;
  group.put("time", {"sample"}, {"s", "end of the sample"}, time);
  group.put("position", {"sample"}, {"1", "position of the plan, from 1"}, position, Type::i32);
  group.put("phase", {"sample"}, {"1", "0 dwell, 1 slew"}, phase, Type::i8);
  for (const char* coordinate : {"time", "position", "phase"})
    group.mark_coordinate(coordinate, "sample");
  auto residual = nothing(at.fits() * samples * channels), nis = nothing(at.fits() * samples),
       scalars = nis;
  for (const identification::FilterRun& run : id.runs) {
    const std::size_t first = at.fit(id.summaries[run.filter].name, run.start) * samples;
    for (std::size_t i = 0; i < samples; ++i) {
      std::ranges::copy(whitened_residuals(run, i),
                        residual.begin() + static_cast<std::ptrdiff_t>((first + i) * channels));
      nis[first + i] = run.history.nis[i];
      scalars[first + i] = run.history.scalars[i];
    }
  }
  group.put("noise", {"sample", "channel"}, {"as channel_unit says", "declared, 1 sigma"}, noise);
  group.put("residual", {"filter", "start", "sample", "channel"},
            {"1", "batch fit: measured minus predicted, over noise"}, residual);
  group.put("nis", {"filter", "start", "sample"},
            {"1", "EKF: normalised innovation squared of the sample"}, nis);
  group.put("scalars", {"filter", "start", "sample"}, {"1", "measured scalars that nis sums over"},
            scalars);
}

void write_results(const identification::Identification& id, const mc::Facts& facts,
                   const std::string& path) {
  const std::vector<NamedResult> results = named_results(id);
  const Places at(results);
  mc::Hdf5Output file(path);
  for (const auto& [key, value] : facts) file.set_text("/", key, value);
  NamedGroup group(file, "");
  group.name_along("estimator", {"ekf", "batch"}, "how it was estimated");
  group.name_along("filter", at.filters, "filter of the study");
  group.number_along("start", at.starts, 1, "initial estimate, from 1");
  mc::put_parameter_dimension(group, at.params);
  NamedGroup::Names again;
  for (const std::size_t p : at.params) again.push_back(parameter_key(p));
  group.name_along("parameter_2", again, "the same parameters once more");
  group.name_along("channel", {std::begin(channel_names), std::end(channel_names)},
                   "what is measured");
  group.put_words("channel_unit", "channel", {"ug", "ug", "ug", "arcsec", "arcsec", "arcsec"},
                  "unit of the noise");
  group.mark_coordinate("channel_unit", "channel");
  group.number_along("sample", id.samples.size(), 0, "number of the sample");
  put_estimates(group, at, results);
  if (id.truth) put_truth(group, at, id.truth->theta);
  put_samples(group, at, id);
  file.complete();
}

}  // namespace

void write_identification_netcdf(const identification::Identification& id, const mc::Facts& facts,
                                 const std::string& path, const std::string& temporary) {
  try {
    write_results(id, facts, temporary);
  } catch (const mc::Hdf5Output::Refused&) {
    throw_cannot_write(path, "HDF5 cannot complete the file, or it does not read back as written");
  }
}

}  // namespace drift::report
