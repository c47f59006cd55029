#pragma once

#include <optional>

#include "core/base/results/begun_folder.hpp"

namespace drift {

/// While it lives, no other process writes an answer into the folder, which is made if need be: the
/// files of two commands that end at the same time never stand mixed, those of the later one stay.
/// On a file system that does not lock folders (some network ones) nobody waits. Where nothing was
/// written in its turn, nothing that it made is left (BegunFolder).
///
/// InputError: io if the folder cannot be made; store if another process, one that is stopped
/// perhaps, does not end writing within half a minute.
class ResultsTurn {
 public:
  explicit ResultsTurn(const ResultsFolder& folder);
  ~ResultsTurn();
  ResultsTurn(const ResultsTurn&) = delete;
  ResultsTurn& operator=(const ResultsTurn&) = delete;

 private:
  bool locked();  ///< false: the folder is another one than the one that was opened

  ResultsFolder folder_;
  std::optional<BegunFolder> begun_;
  int fd_ = -1;  ///< of the folder itself: a lock that leaves no file behind
};

}  // namespace drift
