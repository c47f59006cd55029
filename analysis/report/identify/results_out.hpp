#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/identification/identify.hpp"
#include "core/base/results/folder.hpp"
#include "mc/store/provenance.hpp"

namespace drift::report {

/// An estimator's result of one filter and start, with the words that name it in files.
struct NamedResult {
  const identification::FilterSummary& summary;
  const identification::FilterRun& run;
  const char* estimator;  ///< "ekf" or "batch"
  const EstimateResult& result;

  /// Covariance of the parameters k and l, in their units.
  double covariance(std::size_t k, std::size_t l) const;
};

/// By filter, start and estimator.
std::vector<NamedResult> named_results(const identification::Identification& id);

/// "ok", "not_converged", "diverged"
const char* status_key(EstimateStatus status);

/// What is measured in a sample, in the order of the rows of whitened_residuals().
inline constexpr const char* channel_names[] = {"acc_x",        "acc_y",         "acc_z",
                                                "gimbal_outer", "gimbal_middle", "gimbal_inner"};

/// Measured minus predicted of sample i by the batch fit, over 1 sigma of the noise; NaN where
/// nothing was measured.
std::vector<double> whitened_residuals(const identification::FilterRun& run, std::size_t i);

/// The first line of covariance.csv.
inline constexpr std::string_view covariance_header =
    "filter,coupling,start,estimator,parameter,parameter_2,unit,unit_2,covariance,correlation\n";
/// Its rows of one result, each pair once; head: what stands in the first four columns.
std::string covariance_rows(const std::string& head, const EstimateResult& result);
/// Covariance of its parameters k and l, in their units.
double covariance_of(const EstimateResult& result, std::size_t k, std::size_t l);

/// An identification as tables, a row for each
///   estimates.csv    filter, start, estimator, parameter
///   covariance.csv   the same and a second parameter, each pair once
///   residuals.csv    filter, start, sample: residuals of the batch fit, innovations of the EKF
std::vector<TextFile> result_tables(const identification::Identification& id);

/// The same as netCDF-4 with dimensions estimator, filter, start, parameter, sample, channel.
/// facts: its attributes, from what and with what it was made. InputError (io) naming `path`; the
/// file is written to `temporary`.
void write_identification_netcdf(const identification::Identification& id, const mc::Facts& facts,
                                 const std::string& path, const std::string& temporary);

}  // namespace drift::report
