#pragma once

#include "core/recording/own/guess.hpp"

namespace drift {

/// The unit of a column that may be a channel, by its header, its name or its size; "?": not to be
/// told; empty: none is needed. `gravity`: what the size of the accelerometers says of theirs.
std::string guessed_unit_of(const GuessedColumn& column, const std::string& gravity);

/// Numbers of nothing but nines that are ten times farther from zero than any other of their
/// column stand for what was not measured: for `missing` of the format, and out of the limits of
/// the column. Of columns that are measured or unknown, a time or a number counts on; and not where
/// another one reads that number.
void leave_out_nines(GuessedFile& file);

/// How the file is read as the channels that its columns may be, and whether that is all it needs.
void fill_format(GuessedFile& file);

}  // namespace drift
