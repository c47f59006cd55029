// A library to preload: lets a call that changes files fail as a disk does, the n-th one, once.
//
//   DRIFT_FAULT_AT=9        which call, counted from 0 in each line of processes
//   DRIFT_FAULT_KIND=write  write, fsync, open, rename, close, or any of these (the default); read
//   DRIFT_FAULT_UNDER=DIR   the folder whose files cannot be read
//   DRIFT_FAULT_ERRNO=28    what it says; ENOSPC by default
//   DRIFT_FAULT_SIGNAL=15   instead: the process gets this signal, and the call is made
//   DRIFT_FAULT_STICKY=1    all calls after it fail too
//   DRIFT_FAULT_HIT=FILE    made when a call was let fail; no other fails while it is there, unless
//   sticky
//
// or lets every lock be refused, as on a Lustre mounted without flock or an NFS with nolock:
//
//   DRIFT_NO_LOCKS=1        flock and the locks of fcntl say ENOSYS
//
// Standard streams, pipes, devices and the closing of what was only read are left alone.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
  long at = -1;
  int error = ENOSPC, signal = 0;
  bool sticky = false;
  const char* kind = "any";
  const char* under = nullptr;
  const char* hit = nullptr;
};

const Plan& plan() {
  static const Plan made = [] {
    Plan p;
    if (const char* at = std::getenv("DRIFT_FAULT_AT")) p.at = std::atol(at);
    if (const char* error = std::getenv("DRIFT_FAULT_ERRNO")) p.error = std::atoi(error);
    if (const char* number = std::getenv("DRIFT_FAULT_SIGNAL")) p.signal = std::atoi(number);
    if (const char* kind = std::getenv("DRIFT_FAULT_KIND")) p.kind = kind;
    p.under = std::getenv("DRIFT_FAULT_UNDER");
    p.sticky = std::getenv("DRIFT_FAULT_STICKY") != nullptr;
    p.hit = std::getenv("DRIFT_FAULT_HIT");
    return p;
  }();
  return made;
}

std::atomic<long> calls{0};

/// True, with errno set, if this call is the one.
bool fails(const char* kind) {
  const Plan& p = plan();
  if (p.at < 0 || (std::strcmp(p.kind, "any") != 0 && std::strcmp(p.kind, kind) != 0)) return false;
  const long number = calls++;
  if (number != p.at && !(p.sticky && number > p.at)) return false;
  if (p.hit != nullptr) {
    // Processes that were forked from one count alike: the fault has happened in another.
    if (!p.sticky && ::access(p.hit, F_OK) == 0) return false;
    const long fd = ::syscall(SYS_openat, AT_FDCWD, p.hit, O_WRONLY | O_CREAT, 0600);
    ::syscall(SYS_close, fd);
  }
  if (p.signal != 0) {
    ::raise(p.signal);
    return false;
  }
  errno = p.error;
  return true;
}

bool is_file(int fd) {
  struct stat info {};
  return fd > 2 && ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
}

/// One of those that are to be read with faults: not what the loader or /proc give.
bool is_read(int fd) {
  const char* under = plan().under;
  if (under == nullptr || std::strcmp(plan().kind, "read") != 0 || !is_file(fd)) return false;
  char link[32], path[4096];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t size = ::readlink(link, path, sizeof path);
  const std::size_t prefix = std::strlen(under);
  return size > static_cast<ssize_t>(prefix) && std::strncmp(path, under, prefix) == 0;
}

bool was_written(int fd) {
  return is_file(fd) && (::fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY;
}

bool is_written(const char* path, int flags) {
  if ((flags & O_ACCMODE) == O_RDONLY) return false;
  for (const char* system : {"/dev/", "/proc/", "/sys/"})
    if (std::strncmp(path, system, std::strlen(system)) == 0) return false;
  return true;
}

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

mode_t mode_in(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
}

bool is_refused_lock(int command) {
  static const bool refused = std::getenv("DRIFT_NO_LOCKS") != nullptr;
  if (!refused) return false;
  for (const int lock : {F_GETLK, F_SETLK, F_SETLKW, F_OFD_GETLK, F_OFD_SETLK, F_OFD_SETLKW})
    if (command == lock) return true;
  return false;
}

/// fcntl() with its third argument, which is a number or a pointer, passed on as it came.
int passed_on(const char* name, int fd, int command, void* argument) {
  if (is_refused_lock(command)) {
    errno = ENOSYS;
    return -1;
  }
  return real<int (*)(int, int, ...)>(name)(fd, command, argument);
}

}  // namespace

extern "C" {

int flock(int fd, int operation) noexcept {
  static const auto next = real<int (*)(int, int)>("flock");
  if (!is_refused_lock(F_SETLK)) return next(fd, operation);
  errno = ENOSYS;
  return -1;
}
int fcntl(int fd, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  return passed_on("fcntl", fd, command, argument);
}
int fcntl64(int fd, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  return passed_on("fcntl64", fd, command, argument);
}

ssize_t write(int fd, const void* data, size_t n) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t)>("write");
  return is_file(fd) && fails("write") ? -1 : next(fd, data, n);
}
ssize_t pwrite(int fd, const void* data, size_t n, off_t at) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return is_file(fd) && fails("write") ? -1 : next(fd, data, n, at);
}
ssize_t pwrite64(int fd, const void* data, size_t n, off64_t at) {
  static const auto next = real<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  return is_file(fd) && fails("write") ? -1 : next(fd, data, n, at);
}
ssize_t read(int fd, void* data, size_t n) {
  static const auto next = real<ssize_t (*)(int, void*, size_t)>("read");
  return is_read(fd) && fails("read") ? -1 : next(fd, data, n);
}
ssize_t pread(int fd, void* data, size_t n, off_t at) {
  static const auto next = real<ssize_t (*)(int, void*, size_t, off_t)>("pread");
  return is_read(fd) && fails("read") ? -1 : next(fd, data, n, at);
}
ssize_t pread64(int fd, void* data, size_t n, off64_t at) {
  static const auto next = real<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
  return is_read(fd) && fails("read") ? -1 : next(fd, data, n, at);
}
size_t fwrite(const void* data, size_t size, size_t n, FILE* file) {
  static const auto next = real<size_t (*)(const void*, size_t, size_t, FILE*)>("fwrite");
  return is_file(::fileno(file)) && fails("write") ? 0 : next(data, size, n, file);
}
int fsync(int fd) {
  static const auto next = real<int (*)(int)>("fsync");
  return fails("fsync") ? -1 : next(fd);
}
int fdatasync(int fd) {
  static const auto next = real<int (*)(int)>("fdatasync");
  return fails("fsync") ? -1 : next(fd);
}
int ftruncate64(int fd, off64_t size) noexcept {
  static const auto next = real<int (*)(int, off64_t)>("ftruncate64");
  return fails("write") ? -1 : next(fd, size);
}
int rename(const char* from, const char* to) noexcept {
  static const auto next = real<int (*)(const char*, const char*)>("rename");
  return fails("rename") ? -1 : next(from, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  static const auto next = real<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
  return fails("rename") ? -1 : next(from_folder, from, to_folder, to, flags);
}
int link(const char* from, const char* to) noexcept {
  static const auto next = real<int (*)(const char*, const char*)>("link");
  return fails("rename") ? -1 : next(from, to);
}
int close(int fd) {
  static const auto next = real<int (*)(int)>("close");
  if (!was_written(fd) || !fails("close")) return next(fd);
  next(fd);  // the descriptor is gone whatever close() says
  errno = plan().error;
  return -1;
}
int open(const char* path, int flags, ...) {
  static const auto next = real<int (*)(const char*, int, mode_t)>("open");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  return is_written(path, flags) && fails("open") ? -1 : next(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  static const auto next = real<int (*)(const char*, int, mode_t)>("open64");
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  return is_written(path, flags) && fails("open") ? -1 : next(path, flags, mode);
}

}  // extern "C"
