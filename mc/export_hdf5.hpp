#pragma once

#include <string>

#include "mc/study_reader.hpp"

namespace drift::mc {

/// Writes all results as HDF5 that h5py, netCDF4, xarray and Octave open: numeric datasets only, with
/// dimension scales; names stand in attributes (flag_meanings, long_name). Values in the unit of the
/// attribute `units`; missing is NaN.
///
///   /             attributes: provenance
///   /runs         one row per run: point, run, status, and a dataset per column
///   /summary      point x column, runs that are ok: n, mean, sd, min, max
///
/// Where study points have different columns there is a group /runs_1, /summary_1, /runs_2, ... for
/// every set of columns. Bounded memory; the file is complete or not there. InputError (io).
void export_hdf5(StudyReader& reader, const StopRules& rules, const std::string& path);

}  // namespace drift::mc
