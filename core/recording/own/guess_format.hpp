#pragma once

#include "core/recording/own/guess.hpp"

namespace drift {

/// The unit of a column that may be a channel, by its header, its name or its size; "?": not to be
/// told; empty: none is needed. `gravity`: what the size of the accelerometers says of theirs.
std::string guessed_unit_of(const GuessedColumn& column, const std::string& gravity);

/// How the file is read as the channels that its columns may be, and whether that is all it needs.
void fill_format(GuessedFile& file);

}  // namespace drift
