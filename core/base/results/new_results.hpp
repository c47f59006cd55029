#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/atomic_file.hpp"
#include "core/base/results/begun_folder.hpp"
#include "core/base/results/register.hpp"

namespace drift {

/// The files of an answer, which appear in a results folder together or not at all. What is added
/// is written at once, under a temporary name; commit() gives all of them their names. Before that,
/// and if a file cannot be written, the folder and the answer of an earlier call are as they were.
/// A signal that asks the program to end waits until all have theirs (StopLater).
///
/// Every function, with the folder as it was: InputError store if a name is somebody else's file;
/// io if it is no file, or cannot be written.
class NewResults {
 public:
  /// Makes the folder and marks it as the command's, if need be.
  explicit NewResults(ResultsFolder folder);

  void add(const std::string& name, std::string_view text);
  /// A file that `write` fills at the path it is given.
  void add(const std::string& name, const std::function<void(const std::string& temporary)>& write);
  /// That the answer does not have a file of an earlier call, if there is one.
  void remove(const std::string& name);

  /// Names of the files that were added. InputError (io) also if the names of files may not have
  /// reached the disk; or, on a file system that does not exchange files, says which are of the new
  /// answer already.
  std::vector<std::string> commit();

 private:
  struct Change {
    std::string name, hash;  ///< no hash: it is taken away
    std::unique_ptr<AtomicFile> file;
  };
  std::string path_of(const std::string& name) const;
  AtomicFile& change(const std::string& name, const std::string& hash);
  [[noreturn]] void take_back(std::size_t failed, const std::string& reason);

  ResultsFolder folder_;
  BegunFolder begun_;
  ResultsRegister known_;
  std::vector<Change> changes_;  ///< goes before the folder may
};

}  // namespace drift
