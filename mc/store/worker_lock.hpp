#pragma once

#include <string>

namespace drift::mc {

/// What the file system does for processes that want the same file.
enum class Locks {
  kernel,
  none  ///< Lustre mounted without flock, NFS with nolock: every call that locks fails
};

/// How long a process waits for another that is this worker [s]: the ranks of a killed mpirun take
/// a moment to die.
inline constexpr double worker_patience = 5.0;

/// Whether the file system of an existing file has the locks that SQLite needs.
Locks probe_locks(const std::string& file);

/// Keeps a second process from doing the same worker's work: "worker-0003.lock", which the kernel
/// lets go of however its process ends, so it is never stale. Where there are no locks,
/// "worker-0003.holder.lock" stands while a process is at work and names it; one that has ended on
/// this machine is taken over from, of one on another machine nobody knows.
class WorkerLock {
 public:
  /// `worker_file`: "folder/worker-0003.sqlite". InputError (store) if another process is at work
  /// after `patience` [s], (io) if the folder cannot be written to.
  WorkerLock(const std::string& worker_file, double patience);
  ~WorkerLock();
  WorkerLock(const WorkerLock&) = delete;
  WorkerLock& operator=(const WorkerLock&) = delete;

  Locks locks() const { return locks_; }

 private:
  void hold(double patience);

  int fd_;
  Locks locks_;
  std::string holder_;
  std::string held_;  ///< what this process wrote into the holder's file; empty: it made none
};

/// InputError (store), as of WorkerLock, if another process is at work as this worker after
/// `patience` [s]. Makes no file and keeps nobody out.
void require_no_other(const std::string& worker_file, double patience);

/// Whether a process works on the file of a worker, as far as can be told from here.
enum class AtWork { yes, no, unknown };
AtWork is_at_work(const std::string& worker_file);

/// Whether a process that may be at work holds the file of a worker without the kernel's locks.
bool is_held(const std::string& worker_file);

}  // namespace drift::mc
