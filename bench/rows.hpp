#pragma once

#include <fmt/format.h>

#include <ctime>
#include <string_view>

namespace drift::bench {

/// CPU time of this process, all threads [s].
inline double cpu_time() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A line of the table that bench/table.sh makes: what one unit of work takes with driftscope and
/// with a peer [CPU s], minima of interleaved repetitions in this process; spread: of our
/// repetitions, a usual one over the quickest. No tabs in the note.
inline void print_row(std::string_view key, double ours_s, double peer_s, double spread,
                      std::string_view note) {
  fmt::print("row\t{}\t{:.9g}\t{:.9g}\t{:.3f}\t{}\n", key, ours_s, peer_s, spread, note);
}

}  // namespace drift::bench
