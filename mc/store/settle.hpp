#pragma once

#include <string>

namespace drift::mc {

/// For a worker file that is about to be read without locks: waits for the end of the transaction
/// that its writer is in, and undoes the half of one that a killed writer left, as SQLite does
/// where there are locks. A writer that neither ends nor goes on within two seconds is left alone:
/// what it has written is under checksums.
void settle(const std::string& worker_file);

}  // namespace drift::mc
