#pragma once

#include <filesystem>
#include <vector>

#include "core/base/results/folder.hpp"

namespace drift {

/// A results folder that is made, and marked as a command's, if need be. When the object goes while
/// no file of the command is there, what it made is taken away again: a command that ends in an
/// error leaves no folder that looks like results.
class BegunFolder {
 public:
  /// InputError (io), with nothing made.
  explicit BegunFolder(const ResultsFolder& folder);
  ~BegunFolder();
  BegunFolder(const BegunFolder&) = delete;
  BegunFolder& operator=(const BegunFolder&) = delete;

  /// It is left as it is, whatever comes.
  void stay();

 private:
  void undo();

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< the folder and those above it, it first
  bool marked_ = false;
};

}  // namespace drift
