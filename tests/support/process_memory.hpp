#pragma once

#include <sys/resource.h>

namespace drift::test {

/// The most memory that this process has held so far [kB].
inline long most_memory_kb() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss;
}

}  // namespace drift::test
