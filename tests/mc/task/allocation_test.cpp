// After warm-up, a run of a study allocates nothing in its filters. glibc's own entry points carry
// the work; these only count. Sanitizers bring their own, so the test is left out with them.
#if defined(__has_feature)  // clang
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DRIFT_SANITIZED
#endif
#endif
#if !defined(DRIFT_SANITIZED) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <gtest/gtest.h>

#include "core/estimate/sequential/iterated_passes.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/support/counted_allocations.hpp"

namespace drift::allocation_test {
namespace {

using namespace drift::test;

/// Allocations of `runs` runs after the first two.
long allocations_of(const mc::Overrides& overrides, int runs) {
  const mc::StudyTask task(read_text(small_study, overrides));
  const auto worker = task.worker();
  std::vector<double> row(task.columns().size());
  worker->execute(0, row);
  worker->execute(1, row);
  const long before = allocations;
  for (int run = 2; run < 2 + runs; ++run) worker->execute(static_cast<std::uint64_t>(run), row);
  return allocations - before;
}

TEST(Allocations, AreCounted) {
  const long before = allocations;
  std::vector<int>* const kept = new std::vector<int>(1000);
  EXPECT_GE(allocations - before, 2);
  delete kept;
}

TEST(Allocations, ARunOfAStudyMakesNoneInItsFilters) {
  // More filters on the same data allocate nothing more; what is left is the simulation.
  const std::string all =
      "[\"fixed_drift\", \"g_drift\", \"g2_drift\", \"gyro_misalignment\", \"torquer_scale\", "
      "\"accelerometer\"]";
  const std::string memory = "[\"fixed_drift\", \"warmup_drift\", \"torquer_heating\"]";
  for (const std::string& terms : {std::string("[\"fixed_drift\"]"), all, memory})
    for (const char* estimator : {"ekf", "iterated"})
      for (const char* sample : {"2 min", "20 s"}) {  // and with dwells through polynomials
        const auto count = [&](const char* starts) {
          return allocations_of({{"monte_carlo.estimator", estimator},
                                 {"plan.sample", sample},
                                 {"filter.right.terms", terms},
                                 {"filter.right.starts", starts}},
                                5);
        };
        const long few = count("1"), many = count("6");
        EXPECT_EQ(many, few) << estimator << terms << sample;
        std::printf("%s: %ld allocations in a run, all of the simulation\n", estimator, few / 5);
      }
}

}  // namespace
}  // namespace drift::allocation_test
#endif
