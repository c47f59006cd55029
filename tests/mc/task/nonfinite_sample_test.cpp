// Own terms that are no number in some runs, where they act on what is measured.
#include <gtest/gtest.h>

#include "core/physics/own/own_terms.hpp"
#include "mc/task/trace.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/support/own_terms.hpp"

namespace drift::nonfinite_sample_test {
namespace {

using namespace drift::test;

/// The library is everybody's: it is left as it was.
class NonfiniteSample : public testing::Test {
  KeptOwnTerms kept_;
};

/// A root of what is drawn about 1 with a sigma of 1: no number in 16 % of the runs.
mc::Study with_root(const std::string& target, const std::string& unit,
                    const mc::Overrides& overrides = {}) {
  std::string text = small_study;
  const std::string terms = "\"K0\"]\n[[filter]]";
  text.replace(text.find(terms), terms.size(),
               "\"K0\", \"root\"]\n[truth.parameters]\nroot_S = { normal = [1, 1] }\n[[filter]]");
  text += own_term("root", target, "A*sqrt(S)",
                   "A = { unit = '" + unit + "', prior = 10 }, S = { value = 1 }");
  return read_text(text, overrides);
}

struct Outcome {
  mc::RunOutcome run;
  double S = 0.0;  ///< as drawn
};
std::vector<Outcome> outcomes(const mc::Study& study, std::uint64_t runs) {
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  const auto& truth = task.layout().truth;
  const auto place = std::ranges::find(truth, *TermLibrary::find("root_S")) - truth.begin();
  std::vector<Outcome> all;
  for (std::uint64_t r = 0; r < runs; ++r) {
    std::vector<double> row(task.columns().size(), std::nan(""));
    Outcome o{worker->execute(r, row), 0.0};
    o.S = row[static_cast<std::size_t>(place)];
    all.push_back(std::move(o));
  }
  return all;
}

TEST_F(NonfiniteSample, FailsTheRunAndNamesTheTerm) {
  struct Case {
    const char *target, *unit, *channel;
  };
  for (const Case& c :
       {Case{"accelerometer.z", "ug", "acc_z"}, Case{"gimbal.middle", "arcsec", "gimbal_middle"}}) {
    int failed = 0;
    for (const Outcome& o : outcomes(with_root(c.target, c.unit), 64)) {
      EXPECT_EQ(o.run.status == mc::RunStatus::nonfinite, o.S < 0.0) << o.S;
      if (o.S >= 0.0) continue;
      ++failed;
      EXPECT_EQ(o.run.cause.find(std::string(c.channel) +
                                 " is no finite number at t = 120 s, with root (root_A = "),
                0u)
          << o.run.cause;
      EXPECT_EQ(o.run.t_failed, 120.0);
    }
    EXPECT_GT(failed, 0);
  }
}

TEST_F(NonfiniteSample, OfWhatIsNotMeasuredHarmsNothing) {
  const auto unread = with_root("accelerometer.z", "ug", {{"readout.accelerometers", "false"}});
  int negative = 0;
  for (const Outcome& o : outcomes(unread, 64)) {
    EXPECT_NE(o.run.status, mc::RunStatus::nonfinite) << o.run.cause;
    negative += o.S < 0.0 ? 1 : 0;
  }
  EXPECT_GT(negative, 0);
}

/// Counts what it is told.
struct CountingSink : mc::TraceSink {
  void columns(const std::vector<mc::Column>&) override {}
  void row(std::span<const double>) override { ++rows; }
  int rows = 0;
};

TEST_F(NonfiniteSample, ReplaySaysTheSame) {
  const mc::Study study = with_root("accelerometer.z", "ug");
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  const auto all = outcomes(study, 64);
  const auto first = std::ranges::find_if(all, [](const Outcome& o) { return o.S < 0.0; });
  ASSERT_NE(first, all.end());
  const auto run = static_cast<std::uint64_t>(first - all.begin());
  std::vector<double> row(task.columns().size(), std::nan(""));
  CountingSink sink;
  const mc::RunOutcome again = worker->trace(run, row, sink);
  EXPECT_EQ(again.status, first->run.status);
  EXPECT_EQ(again.cause, first->run.cause);
  EXPECT_EQ(sink.rows, 0) << "no filter was given what is no test";
  EXPECT_EQ(mc::trace_run(study, run).ode.status, OdeStatus::sample_nonfinite);
}

}  // namespace
}  // namespace drift::nonfinite_sample_test
