// Whatever happens in a run is an outcome of that run.
#include "mc/task/guarded_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace drift::guarded_run_test {
namespace {

/// Run 2 throws, by itself and among others.
class Worker final : public mc::RunWorker {
 public:
  mc::RunOutcome execute(std::uint64_t run, std::span<double> row) override {
    row[0] = static_cast<double>(run);
    if (run == 2) throw std::runtime_error("run 2");
    return {};
  }
  using mc::RunWorker::execute;
};

TEST(GuardedRun, OneOfAGroupThatThrowsHarmsNoOther) {
  Worker worker;
  std::vector<double> rows(4, std::numeric_limits<double>::quiet_NaN());
  std::vector<mc::RunWork> runs;
  for (std::size_t k = 0; k < 4; ++k) runs.push_back({k, std::span(rows).subspan(k, 1), {}});
  mc::guarded_runs(worker, runs);
  for (const mc::RunWork& w : runs) {
    const bool guilty = w.run == 2;
    EXPECT_EQ(w.outcome.status, guilty ? mc::RunStatus::error : mc::RunStatus::ok) << w.run;
    EXPECT_EQ(w.outcome.cause, guilty ? "run 2" : "");
    EXPECT_EQ(std::isnan(w.row[0]), guilty);
    if (!guilty) {
      EXPECT_EQ(w.row[0], static_cast<double>(w.run));
    }
  }
}

}  // namespace
}  // namespace drift::guarded_run_test
