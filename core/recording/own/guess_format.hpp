#pragma once

#include "core/recording/own/guess.hpp"

namespace drift {

/// How the file is read as the channels that its columns may be, and whether that is all it needs.
void fill_format(GuessedFile& file);

}  // namespace drift
