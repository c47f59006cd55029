// LLVM's OpenMP library notes in shared memory that it is in this process, to find a second one of
// its kind. Where /dev/shm may not be written to it ends the process, and what is killed leaves a
// file there for good. What it opens is memory of this process alone instead.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>

#include <cerrno>
#include <string_view>

extern "C" {

/// Stands before the C library's for the libraries of this program.
__attribute__((visibility("default"))) int shm_open(const char* name, int flags, mode_t mode) {
  constexpr std::string_view of_openmp = "/__KMP_REGISTERED_LIB_";
  if (std::string_view(name).starts_with(of_openmp)) {
    if ((flags & O_CREAT) != 0) return memfd_create(name + 1, MFD_CLOEXEC);
    errno = ENOENT;  // nothing to be taken back at the end
    return -1;
  }
  using Open = int (*)(const char*, int, mode_t);
  const auto open = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "shm_open"));
  if (open != nullptr) return open(name, flags, mode);
  errno = ENOSYS;
  return -1;
}
}
