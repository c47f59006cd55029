#pragma once

#include <string>

namespace drift {

/// A file that comes into being complete or not at all: it is written under a temporary name in
/// the same folder and renamed at the end. Without commit() the temporary file is removed.
/// Only a regular file is replaced; a symbolic link to one stays, and its target is replaced.
class AtomicFile {
 public:
  /// InputError (io) if the folder cannot be written to, or a directory, device, pipe, socket or
  /// other link has that name.
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
  void refuse_what_is_no_file() const;
  void sync_temporary();
  void sync_folder();

  std::string path_, temporary_;
};

/// InputError (io) "path: cannot be written: reason. What to do".
[[noreturn]] void throw_cannot_write(const std::string& path, const std::string& reason);

}  // namespace drift
