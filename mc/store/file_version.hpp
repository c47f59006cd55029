#pragma once

#include <cstdint>
#include <string>

namespace drift::mc {

/// By what a change of a SQLite file shows that is read without locks.
struct FileVersion {
  std::uint32_t changes = 0;  ///< SQLite's own count of transactions
  std::uint64_t bytes = 0;
  bool changing = false;  ///< a journal stands beside it: a writer is amid a transaction, or was
  bool operator==(const FileVersion&) const = default;
};

/// Not for files that this process has locked: looking at them would let go of the lock.
FileVersion version_of(const std::string& path);

/// Which file has a name: another one, where it was replaced by a rename.
struct FileIdentity {
  std::uint64_t device = 0, number = 0;  ///< 0: none
  bool operator==(const FileIdentity&) const = default;
};
FileIdentity identity_of(const std::string& path);

}  // namespace drift::mc
