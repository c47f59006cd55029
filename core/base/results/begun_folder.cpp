#include "core/base/results/begun_folder.hpp"

#include <unistd.h>

#include <algorithm>

#include "core/base/atomic_file.hpp"
#include "core/base/results/register.hpp"

namespace drift {

namespace fs = std::filesystem;

BegunFolder::BegunFolder(const ResultsFolder& folder) : path_(folder.path) {
  std::error_code error;
  for (fs::path at = path_; !at.empty() && !fs::exists(at, error) && at != at.parent_path();
       at = at.parent_path())
    made_.push_back(at);
  try {
    error.clear();
    fs::create_directories(path_, error);
    if (error) throw_cannot_write(path_.string(), error.message());
    ResultsRegister known(path_.string());
    marked_ = known.command().empty();
    // Of a folder whose register is lost nothing is taken for the command's own that does not say
    // so under a checksum of its own: a file called report.html may be anybody's.
    if (marked_) known.add(folder.command, {});
  } catch (...) {
    undo();
    throw;
  }
}

// NOLINTNEXTLINE(bugprone-exception-escape): without memory for a few names nothing goes on
BegunFolder::~BegunFolder() {
  undo();
}

void BegunFolder::stay() {
  made_.clear();
  marked_ = false;
}

void BegunFolder::undo() {
  std::error_code none;
  if (marked_) {
    const auto is_there = [&](const std::string& name) {
      return fs::exists(fs::symlink_status(path_ / name, none));
    };
    if (std::ranges::any_of(ResultsRegister(path_.string()).names(), is_there)) return;
    ::unlink((path_ / ResultsRegister::file_name).c_str());
  }
  for (const fs::path& folder : made_) ::rmdir(folder.c_str());  // those that are empty
}

}  // namespace drift
