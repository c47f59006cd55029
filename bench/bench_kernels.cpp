// How near the kernels of a study come to what a core can do: each beside the time that its fused
// multiply-adds alone would take, at the rate that this core has with all operands in registers,
// measured in between. In the rows of the table `ratio` is that share.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bench/repeated.hpp"
#include "bench/rows.hpp"
#include "core/estimate/sequential/in_lanes/lane_covariance.hpp"
#include "core/estimate/sequential/in_lanes/lane_information.hpp"

namespace drift::bench {
namespace {

constexpr std::size_t parameters = 60;  // of a filter with base terms
constexpr int rounds = 15;

/// Numbers that nothing makes large: rows of a well-behaved problem.
double small_number() {
  static std::uint64_t state = 1;
  state = state * 6364136223846793005ULL + 1442695040888963407ULL;
  return (static_cast<double>(state >> 40) / 16777216.0 - 0.5) * 0.05;
}
Pack small_numbers() {
  return Pack::of_each([](int) { return small_number(); });
}

/// Seconds of one fused multiply-add of a pack where nothing has to be fetched: enough of them at
/// once to fill the pipelines.
double seconds_at_peak() {
  constexpr int at_once = 12, times = 200000;
  std::array<Pack, at_once> sum;
  for (Pack& s : sum) s = small_numbers();
  const Pack a = Pack(1.0) - small_numbers() * Pack(1e-6), b = small_numbers();
  const double start = cpu_time();
  for (int k = 0; k < times; ++k)
#pragma GCC unroll 12
    for (int i = 0; i < at_once; ++i) sum[i] = mul_add(a, sum[i], b);
  const double seconds = cpu_time() - start;
  volatile double kept = 0.0;
  for (const Pack& s : sum) kept = kept + s[0];
  return seconds / (times * at_once);
}

/// The quickest of several, the peak measured in between.
template <class Kernel>
void row_of(const char* key, double multiply_adds, int times, const char* note, Kernel&& kernel) {
  Repeated ours;
  double peak = 1.0;
  for (int k = 0; k < rounds; ++k) {
    peak = std::min(peak, seconds_at_peak());
    const double start = cpu_time();
    for (int t = 0; t < times; ++t) kernel();
    ours.add({(cpu_time() - start) / times, 0, {}});
  }
  print_row(key, ours.best.seconds, multiply_adds * peak, ours.spread(),
            fmt::format("{}: {:.0f} fused multiply-adds of {} numbers; ratio: share of their peak, "
                        "{:.3g} GFLOP/s",
                        note, multiply_adds, Pack::width, 2e-9 * Pack::width / peak));
}

void rows() {
  constexpr std::size_t side = (parameters + 3) / 4, tiles = side * (side + 1) / 2;
  LaneCovariance P(parameters);
  std::vector<Pack> step(parameters);
  const auto put = [](auto& to) {
    for (std::size_t k = 0; k <= parameters; ++k) {
      Pack* at = to.at(k);
      for (std::size_t i = 0; i < 3; ++i) at[4 * i] = small_numbers();
    }
  };
  put(P);
  // What an update owes comes off (3 rows), rows times the matrix from both sides of the diagonal.
  row_of("peak_covariance", 48.0 * tiles + 96.0 * tiles - 48.0 * side, 200,
         "three rows into a covariance of 60", [&] { P.take(step); });

  constexpr std::size_t with_right = parameters / 4 + 1;
  LaneInformation information(parameters);
  int batch = 0;
  while (!information.full()) {
    information.begin_rows(0, false);
    put(information);
    ++batch;
  }
  const int rows_of_batch = 3 * batch;
  information.flush(false);
  row_of("peak_information", 16.0 * rows_of_batch * (with_right * (with_right + 1) / 2.0), 200,
         "36 rows into an information matrix of 60", [&] {
           while (!information.full()) information.begin_rows(0, false);
           information.flush(false);
         });
  const double n = 4.0 * with_right;
  row_of("peak_factorise", n * (n * n - 1.0) / 6.0, 200, "roots of information matrices of 60",
         [&] { information.factorise(); });
}

}  // namespace
}  // namespace drift::bench

int main() {
  drift::bench::rows();
}
