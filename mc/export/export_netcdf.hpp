#pragma once

#include <string>
#include <vector>

#include "mc/store/study_reader.hpp"
#include "mc/study/sweep.hpp"

namespace drift::mc {

/// Writes all results as netCDF-4 whose arrays are addressed by names, as xarray does:
/// `ds.estimate.sel(filter="eq6", parameter="eta_x")`.
///
///   /             dimensions run, filter, start, parameter, before them point where the study has
///                 several; estimate, sigma, truth, what the statistics of a fit are, priors;
///                 attributes: provenance
///   /statistics   (filter, parameter): RMSE, coverage, silent failures ... (export_table.hpp)
///   /filters      (filter, start): NIS, NEES, shares of runs that are healthy, wrong ...
///
/// Numbers stand in the unit that the coordinate parameter_unit or the attribute `units` names;
/// what a filter does not estimate is NaN. Bounded memory; the file is complete or not there.
/// InputError (io).
void export_netcdf(StudyReader& reader, const StopRules& rules, const std::string& path,
                   const std::vector<StudyPoint>& points);

}  // namespace drift::mc
