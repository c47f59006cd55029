#pragma once

#include <string>
#include <string_view>

namespace drift {

/// A file that comes into being complete or not at all: it is written under a temporary name in
/// the same folder and renamed at the end. Without commit() the temporary file is removed; what a
/// killed process leaves, remove_stale_temporaries() takes away.
/// Only a regular file is replaced; a symbolic link is never followed.
class AtomicFile {
 public:
  /// InputError (io) if the folder cannot be written to, or a directory, device, pipe, socket or
  /// link has that name.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary() const { return temporary_; }  ///< an empty file, to be written

  /// Fills the temporary file. InputError (io) with path and reason, a full disk included.
  void write(std::string_view text);

  /// Brings the file to the disk under its name. InputError (io) if that fails.
  void commit();
  /// The same, but only if there is no file of that name; false, with nothing changed, if there is.
  /// Of several that try at once exactly one succeeds, on network file systems too.
  bool commit_new();

  // For several files that are to appear together: each is synced, then each put, or what stands
  // under its name taken away; until the object goes, take_back() undoes that.

  /// Brings the temporary file to the disk. InputError (io) if that fails.
  void sync();
  /// Gives the file its name. Why it cannot be; empty if it is done.
  std::string put();
  /// Takes away what has the name, instead. Likewise; nothing there is fine.
  std::string take_away();
  /// Everything as it was before. False if it cannot be: a file system that does not exchange files
  /// has forgotten the one that was replaced.
  bool take_back();
  /// Brings the name to the disk. InputError (io) if that fails.
  void sync_folder();

 private:
  enum class Moved { nothing, to_free_name, for_old_file, over_old_file, away };

  std::string path_, temporary_;
  Moved moved_ = Moved::nothing;
};

/// InputError (io) if a name cannot be given to a file: something that is no regular file has it,
/// or the file system refuses it (too long, a folder that may not be entered).
void require_file_name(const std::string& path);

/// InputError (io) "path: cannot be written: reason. What to do".
[[noreturn]] void throw_cannot_write(const std::string& path, const std::string& reason);

}  // namespace drift
