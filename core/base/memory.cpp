#include "core/base/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace drift {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A number of a file of the kernel: that behind `key`, or the first. Infinite if there is none
/// ("max" is none).
double number_in(const char* file, const std::string& key = "") {
  std::ifstream in(file);
  std::string word;
  while (!key.empty() && in >> word && word != key) {
  }
  double number = 0.0;
  return in >> number ? number : unlimited;
}

double below_limit(int resource, double held) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur) - held;
}

}  // namespace

double available_memory() {
  const double on_machine = 1024.0 * number_in("/proc/meminfo", "MemAvailable:");
  const double in_group = number_in("/sys/fs/cgroup/memory.max");
  const double group_holds = number_in("/sys/fs/cgroup/memory.current");
  const double left_in_group = std::isinf(in_group) ? unlimited : in_group - group_holds;
  const double held = number_in("/proc/self/statm") * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return std::max(0.0, std::min({on_machine, left_in_group, below_limit(RLIMIT_AS, held),
                                 below_limit(RLIMIT_DATA, 0.0)}));
}

void require_memory(double bytes, ExitCode code, const std::string& what,
                    const std::string& remedy) {
  constexpr double little = 64e6;  // what need not be looked into
  if (bytes < little) return;
  const double available = available_memory();
  if (bytes <= available) return;
  throw InputError(code,
                   fmt::format("{} would take about {:.3g} GB of memory (expected at most the "
                               "{:.3g} GB that are free). {}",
                               what, bytes / 1e9, available / 1e9, remedy));
}

}  // namespace drift
