// A library to preload: writes down what a process does to files, so that a power failure can be
// made up afterwards at any moment of it (tests/power_failure.py).
//
//   DRIFT_DISK_LOG=FILE     where to
//   DRIFT_DISK_UNDER=DIR    only of files under it
//
// A record is a line of fields apart by tabs, file names last, and after that of a write the bytes:
//   open FILE SIZE PATH | write FILE AT COUNT | size FILE SIZE | sync FILE | syncdir PATH
//   rename FROM TO | link FROM TO | unlink PATH
// FILE is the number of an inode, SIZE the size that the file has then.
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>

namespace {

template <class Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// One at a time, and in the order in which it happens: a call and its record belong together.
std::recursive_mutex& order() {
  static std::recursive_mutex made;
  return made;
}

void record(const std::string& line, const void* data = nullptr, std::size_t count = 0) {
  static const long fd = [] {
    const char* path = std::getenv("DRIFT_DISK_LOG");
    return path == nullptr ? -1L
                           : ::syscall(SYS_openat, AT_FDCWD, path,
                                       O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  }();
  if (fd < 0) return;
  const iovec parts[] = {{const_cast<char*>(line.data()), line.size()},
                         {const_cast<void*>(data), count}};
  if (::syscall(SYS_writev, fd, parts, 2) != static_cast<long>(line.size() + count)) std::abort();
}

bool is_under(const std::string& path) {
  static const char* under = std::getenv("DRIFT_DISK_UNDER");
  return under != nullptr && path.rfind(under, 0) == 0;
}

std::string path_of(int fd) {
  char path[PATH_MAX];
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  const ssize_t length = ::readlink(link.c_str(), path, sizeof path);
  return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : std::string();
}

/// The folder as it is, the last name as it stands.
std::string full(const char* name) {
  const std::string given = name;
  const std::size_t slash = given.rfind('/');
  char folder[PATH_MAX];
  const std::string of = slash == std::string::npos ? "." : given.substr(0, slash + 1);
  if (::realpath(of.c_str(), folder) == nullptr) return given;
  return std::string(folder) + "/" + (slash == std::string::npos ? given : given.substr(slash + 1));
}

/// The number of a file to be written down; empty for all others.
std::string file_of(int fd, long long* size = nullptr) {
  struct stat info {};
  if (fd <= 2 || ::fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) || !is_under(path_of(fd)))
    return {};
  if (size != nullptr) *size = info.st_size;
  return std::to_string(info.st_ino);
}

void opened(int fd, int flags) {
  if (fd < 0 || (flags & O_ACCMODE) == O_RDONLY) return;
  long long size = 0;
  if (const std::string file = file_of(fd, &size); !file.empty())
    record("open\t" + file + "\t" + std::to_string(size) + "\t" + path_of(fd) + "\n");
}

ssize_t written(int fd, const void* data, ssize_t count, long long at) {
  if (count <= 0) return count;
  if (const std::string file = file_of(fd); !file.empty())
    record("write\t" + file + "\t" + std::to_string(at) + "\t" + std::to_string(count) + "\n", data,
           static_cast<std::size_t>(count));
  return count;
}

/// Of a file that another descriptor wrote, perhaps past these functions: all that it holds.
void as_a_whole(int fd, const std::string& file) {
  if ((::fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY) return;
  std::string data;
  char buffer[4096];
  for (ssize_t n = 0;
       (n = ::pread(fd, buffer, sizeof buffer, static_cast<off_t>(data.size()))) > 0;)
    data.append(buffer, static_cast<std::size_t>(n));
  record("write\t" + file + "\t0\t" + std::to_string(data.size()) + "\n", data.data(), data.size());
}

int synced(int fd, int result) {
  struct stat info {};
  if (result != 0 || ::fstat(fd, &info) != 0) return result;
  if (S_ISDIR(info.st_mode)) {
    if (const std::string path = path_of(fd); is_under(path + "/"))
      record("syncdir\t" + path + "\n");
  } else if (const std::string file = file_of(fd); !file.empty()) {
    as_a_whole(fd, file);
    record("sync\t" + file + "\n");
  }
  return result;
}

int resized(int fd, int result, long long size) {
  if (const std::string file = file_of(fd); result == 0 && !file.empty())
    record("size\t" + file + "\t" + std::to_string(size) + "\n");
  return result;
}

mode_t mode_in(int flags, va_list arguments) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
}

int open_as(const char* name, const char* path, int flags, mode_t mode) {
  const std::lock_guard guard(order());
  const int fd = real<int (*)(const char*, int, mode_t)>(name)(path, flags, mode);
  opened(fd, flags);
  return fd;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  return open_as("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_in(flags, arguments);
  va_end(arguments);
  return open_as("open64", path, flags, mode);
}
int mkstemp(char* name) {
  const std::lock_guard guard(order());
  const int fd = real<int (*)(char*)>("mkstemp")(name);
  opened(fd, O_RDWR);
  return fd;
}
int mkostemp(char* name, int flags) {
  const std::lock_guard guard(order());
  const int fd = real<int (*)(char*, int)>("mkostemp")(name, flags);
  opened(fd, O_RDWR);
  return fd;
}

ssize_t write(int fd, const void* data, size_t n) {
  const std::lock_guard guard(order());
  const ssize_t count = real<ssize_t (*)(int, const void*, size_t)>("write")(fd, data, n);
  return written(fd, data, count, count > 0 ? ::lseek(fd, 0, SEEK_CUR) - count : 0);
}
ssize_t pwrite64(int fd, const void* data, size_t n, off64_t at) {
  const std::lock_guard guard(order());
  return written(fd, data,
                 real<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64")(fd, data, n, at),
                 at);
}
ssize_t pwrite(int fd, const void* data, size_t n, off_t at) {
  return pwrite64(fd, data, n, at);
}
int fsync(int fd) {
  const std::lock_guard guard(order());
  return synced(fd, real<int (*)(int)>("fsync")(fd));
}
int fdatasync(int fd) {
  const std::lock_guard guard(order());
  return synced(fd, real<int (*)(int)>("fdatasync")(fd));
}
int ftruncate64(int fd, off64_t size) noexcept {
  const std::lock_guard guard(order());
  return resized(fd, real<int (*)(int, off64_t)>("ftruncate64")(fd, size), size);
}
int ftruncate(int fd, off_t size) noexcept {
  return ftruncate64(fd, size);
}
int rename(const char* from, const char* to) noexcept {
  const std::lock_guard guard(order());
  const std::string names = full(from) + "\t" + full(to);
  const int result = real<int (*)(const char*, const char*)>("rename")(from, to);
  if (result == 0 && is_under(full(to))) record("rename\t" + names + "\n");
  return result;
}
int link(const char* from, const char* to) noexcept {
  const std::lock_guard guard(order());
  const int result = real<int (*)(const char*, const char*)>("link")(from, to);
  if (result == 0 && is_under(full(to))) record("link\t" + full(from) + "\t" + full(to) + "\n");
  return result;
}
int unlink(const char* path) noexcept {
  const std::lock_guard guard(order());
  const std::string name = full(path);
  const int result = real<int (*)(const char*)>("unlink")(path);
  if (result == 0 && is_under(name)) record("unlink\t" + name + "\n");
  return result;
}

}  // extern "C"
