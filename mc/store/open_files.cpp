#include "mc/store/open_files.hpp"

#include <sys/resource.h>

namespace drift::mc {

void allow_many_files() {
  rlimit files{};
  if (::getrlimit(RLIMIT_NOFILE, &files) != 0 || files.rlim_cur >= files.rlim_max) return;
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);  // where that is refused, opening a file says what is wrong
}

}  // namespace drift::mc
