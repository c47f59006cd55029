#pragma once

#include <string>
#include <vector>

#include "mc/store/study_reader.hpp"
#include "mc/study/sweep.hpp"

namespace drift::mc {

/// Writes all results as HDF5 that h5py, netCDF4, xarray and Octave open: numeric datasets only,
/// with dimension scales; names stand in attributes (flag_meanings, long_name). Values in the unit
/// of the attribute `units`; missing is NaN.
///
///   /             attributes: provenance
///   /runs         one row per run: point, run, status, and a dataset per column
///   /summary      point x column: n, mean, sd, min, max over the runs that are ok, and what other
///                 filters found in those in which one diverged
///   /failures     one row per failed run: time and cause; not there if none failed
/// and given the study points whose rows are StudyColumns
///   /points       one row per study point: what was swept; not there if nothing was
///   /statistics, /filters, /convergence   what the runs say of the filters (export_table.hpp)
///
/// Where study points have different columns there is a group /runs_1, /summary_1, /runs_2, ... for
/// every set of columns. Bounded memory; the file is complete or not there. Returns the names of
/// the groups. InputError (io).
std::vector<std::string> export_hdf5(StudyReader& reader, const StopRules& rules,
                                     const std::string& path,
                                     const std::vector<StudyPoint>& points = {});

/// The study_hash that an HDF5 export at this path carries; empty if it is none.
std::string study_hash_of_hdf5(const std::string& path);

}  // namespace drift::mc
