#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace drift {

/// Names of files and their SHA-256, in hexadecimal.
using HashedFiles = std::vector<std::pair<std::string, std::string>>;

/// Which files of a results folder driftscope wrote, and their SHA-256: the file .driftscope in it.
/// Its lines are "<hash>  <name>", as sha256sum writes them, below a comment that names the
/// command. A name may have several: the hash is noted before the file is written, so that
/// whenever the program ends, a file of ours has one that is listed.
class ResultsRegister {
 public:
  static constexpr const char* file_name = ".driftscope";

  /// Reads that of a folder; empty if there is none.
  explicit ResultsRegister(std::string folder);

  /// There is a file of that name, which driftscope did not begin.
  bool is_foreign() const { return foreign_; }
  /// The command that made the folder; empty if that is not known: there is no register, or its
  /// maker was killed before the first line was whole.
  const std::string& command() const { return command_; }
  /// The names, each once.
  std::vector<std::string> names() const;
  /// Whether driftscope wrote a file of this name and content.
  bool has(const std::string& name, const std::string& hash) const {
    return hashes_.contains({name, hash});
  }

  /// Notes names with their hashes; makes the file, or its first line, if need be. Any number of
  /// processes may do so at the same time. InputError (io).
  void add(const std::string& command, const HashedFiles& files);

 private:
  std::string path_, command_;
  bool foreign_ = false;
  std::set<std::pair<std::string, std::string>> hashes_;  ///< (name, hash)
};

/// Names of the files in a folder that are not as driftscope wrote them; those that are gone are
/// not among them. InputError (io) if one cannot be read.
std::vector<std::string> changed_results(const std::string& folder);

}  // namespace drift
