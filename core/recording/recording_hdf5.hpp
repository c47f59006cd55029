#pragma once

#include <string>

#include "core/recording/isolated.hpp"
#include "core/recording/recording.hpp"

namespace drift {

/// HDF5 layout: in the root group one numeric 1-D dataset per channel, named like it, with its unit
/// in a string attribute `unit` (`units` is read too); facts are attributes of the root group.
/// `time` is the dimension scale of the others. There are no string datasets: they crash netCDF4
/// and xarray, or keep Octave from loading the file.
///
/// Reads such a file. Called in a child process (read_isolated), since damaged files can crash the
/// library; checks class, shape and size of a dataset before memory is taken for it.
void read_hdf5(const std::string& path, RawSink& sink);

/// Writes such a file, with `facts` instead of the recording's; returns what went wrong, empty if
/// nothing. Called in a child process.
std::string write_hdf5(const Recording& recording, const Facts& facts, const std::string& path);

}  // namespace drift
