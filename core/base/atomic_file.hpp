#pragma once

#include <string>

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

  /// Brings the file to the disk under its name. InputError (io) if that fails.
  void commit();
  /// The same, but only if there is no file of that name; false, with nothing changed, if there is.
  /// Of several that try at once exactly one succeeds, on network file systems too.
  bool commit_new();

 private:
  void sync_temporary();
  void sync_folder();

  std::string path_, temporary_;
};

/// InputError (io) if a name cannot be given to a file: something that is no regular file has it,
/// or the file system refuses it (too long, a folder that may not be entered).
void require_file_name(const std::string& path);

/// InputError (io) "path: cannot be written: reason. What to do".
[[noreturn]] void throw_cannot_write(const std::string& path, const std::string& reason);

}  // namespace drift
