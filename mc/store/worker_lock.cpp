#include "mc/store/worker_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "core/base/atomic_file.hpp"
#include "core/base/check.hpp"
#include "core/base/process_token.hpp"
#include "core/base/results/regular_file.hpp"
#include "core/base/temporary_file.hpp"
#include "mc/store/provenance.hpp"

namespace drift::mc {
namespace {

namespace fs = std::filesystem;
constexpr auto pause = std::chrono::milliseconds(100);

std::string stem_of(const std::string& worker_file) {
  return worker_file.substr(0, worker_file.size() - std::strlen(".sqlite"));
}

std::string holder_of(const std::string& worker_file) {
  return stem_of(worker_file) + ".holder.lock";
}

int tries_in(double patience) {
  return static_cast<int>(patience / std::chrono::duration<double>(pause).count());
}

/// What a holder's file says; empty if there is none.
std::string text_in(const std::string& path) {
  std::ostringstream text;
  if (!other_than_file(path).empty()) return {};
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Maker maker_in(const std::string& text) {
  return maker_of(text.substr(0, text.find('\n')));
}

/// "process 4711 on node7 since 2026-11-21T09:51:03Z", for people; the line before is for
/// maker_of().
std::string own_text() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{}\nprocess {} on {} since {}\n", process_token(), ::getpid(), host.data(),
                     utc_now());
}

[[noreturn]] void refuse(const std::string& holder, const std::string& text) {
  const std::size_t line = text.find('\n');
  const std::string who = line == std::string::npos
                              ? "another process"
                              : text.substr(line + 1, text.find('\n', line + 1) - line - 1);
  const bool seen = maker_in(text) == Maker::at_work;
  throw InputError(
      ExitCode::store,
      fmt::format("{}: {} {} as this worker (expected one at a time). Wait for it, or share the "
                  "work with --worker i/n{}",
                  holder, who, seen ? "is at work" : "may be at work",
                  seen ? ""
                       : "; the file system has no locks that would tell: if that process has "
                         "ended, remove this file and run the same command again"));
}

/// Locks the file of a worker by the kernel, for as long as it stays open: LOCK_EX, or LOCK_SH to
/// look. False where the kernel cannot. InputError (store) if another process has it locked after
/// `patience` [s].
bool lock_by_kernel(int fd, int kind, const std::string& path, double patience) {
  for (int i = 0; ::flock(fd, kind | LOCK_NB) != 0; ++i) {
    if (errno != EWOULDBLOCK && errno != EINTR) return false;
    if (i >= tries_in(patience))
      throw InputError(ExitCode::store,
                       fmt::format("{}: another process is at work as this worker (expected one "
                                   "at a time). Wait for it, or share the work with --worker i/n",
                                   path));
    std::this_thread::sleep_for(pause);
  }
  return true;
}

/// Takes away the file of a process that has ended. Of several that try, each moves at most one
/// file aside; one that was not the stale one is put back.
void take_over(const std::string& holder, const std::string& stale) {
  const std::string aside = make_temporary(fs::path(holder).parent_path().string());
  if (aside.empty()) throw_cannot_write(holder, std::strerror(errno));
  if (std::rename(holder.c_str(), aside.c_str()) == 0 && text_in(aside) != stale)
    if (::link(aside.c_str(), holder.c_str()) != 0 && errno != EEXIST)
      throw_cannot_write(holder, std::strerror(errno));
  remove_temporary(aside);
}

}  // namespace

Locks probe_locks(const std::string& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return Locks::kernel;  // whoever opens it in earnest says why
  struct flock all {};
  all.l_type = F_RDLCK;
  all.l_whence = SEEK_SET;
  const bool locked = ::fcntl(fd, F_SETLK, &all) == 0;
  const int reason = locked ? 0 : errno;
  ::close(fd);
  return reason == ENOSYS || reason == ENOLCK || reason == EOPNOTSUPP || reason == EINVAL
             ? Locks::none
             : Locks::kernel;
}

WorkerLock::WorkerLock(const std::string& worker_file, double patience)
    : fd_(::open((stem_of(worker_file) + ".lock").c_str(),
                 O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)),
      holder_(holder_of(worker_file)) {
  const std::string path = stem_of(worker_file) + ".lock";
  if (fd_ < 0) throw_cannot_write(path, std::strerror(errno));
  try {
    locks_ = probe_locks(path);
    const bool alone = lock_by_kernel(fd_, LOCK_EX, path, patience);
    // One that stands was made where the same folder has no locks: it counts here too.
    if (!alone || locks_ == Locks::none || fs::exists(holder_)) hold(patience);
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

void WorkerLock::hold(double patience) {
  const std::string mine = own_text();
  for (int i = 0;; ++i) {
    AtomicFile file(holder_);
    std::ofstream out(file.temporary(), std::ios::binary);
    out << mine;
    out.close();
    if (!out) throw_cannot_write(holder_, std::strerror(errno));
    if (file.commit_new()) break;
    const std::string text = text_in(holder_);
    if (maker_in(text) == Maker::ended)
      take_over(holder_, text);
    else if (i >= tries_in(patience))
      refuse(holder_, text);
    else
      std::this_thread::sleep_for(pause);
  }
  held_ = mine;
}

WorkerLock::~WorkerLock() {
  if (!held_.empty() && text_in(holder_) == held_) ::unlink(holder_.c_str());
  ::close(fd_);
}

void require_no_other(const std::string& worker_file, double patience) {
  const std::string path = stem_of(worker_file) + ".lock", holder = holder_of(worker_file);
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0) return;  // there was none yet, or whoever opens it in earnest says why not
  try {
    lock_by_kernel(fd, LOCK_SH, path, patience);
  } catch (...) {
    ::close(fd);
    throw;
  }
  ::close(fd);
  for (int i = 0; is_held(worker_file); ++i) {
    if (i >= tries_in(patience)) refuse(holder, text_in(holder));
    std::this_thread::sleep_for(pause);
  }
}

AtWork is_at_work(const std::string& worker_file) {
  const std::string text = text_in(holder_of(worker_file));
  const Maker holder = maker_in(text);
  if (holder == Maker::at_work) return AtWork::yes;
  const int fd =
      ::open((stem_of(worker_file) + ".lock").c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (fd < 0) return errno == ENOENT && text.empty() ? AtWork::no : AtWork::unknown;
  const bool is_free = ::flock(fd, LOCK_SH | LOCK_NB) == 0;
  const int reason = errno;
  ::close(fd);
  if (!is_free) return reason == EWOULDBLOCK ? AtWork::yes : AtWork::unknown;
  return text.empty() || holder == Maker::ended ? AtWork::no : AtWork::unknown;
}

bool is_held(const std::string& worker_file) {
  const std::string text = text_in(holder_of(worker_file));
  return !text.empty() && maker_in(text) != Maker::ended;
}

}  // namespace drift::mc
