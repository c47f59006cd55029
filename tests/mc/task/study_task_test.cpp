#include "mc/task/study_task.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/estimate/starts.hpp"
#include "core/sim/simulate.hpp"
#include "core/stats/chi_square_band.hpp"
#include "mc/statistics/point_statistics.hpp"
#include "mc/study/design.hpp"
#include "mc/task/trace.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::study_task_test {
namespace {

using namespace drift::test;
using C = mc::StudyColumns;

mc::StudyTask small_task(const mc::Overrides& overrides = {}) {
  return mc::StudyTask(read_text(small_study, overrides));
}

bool same_bits(std::span<const double> a, std::span<const double> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

TEST(StudyTask, RunsDoNotDependOnWhatRanBefore) {
  for (const char* estimator : {"ekf", "iterated", "batch"}) {
    const mc::StudyTask task =
        small_task({{"monte_carlo.estimator", estimator}, {"monte_carlo.design", "sobol"}});
    const auto one = task.worker(), other = task.worker();
    const mc::Block forward = run_block(task, *one, 0, 4);
    const std::size_t width = task.columns().size();
    for (std::uint64_t run = 4; run-- > 0;) {
      const mc::Block alone = run_block(task, *other, run, 1);
      EXPECT_TRUE(same_bits(alone.rows, std::span(forward.rows).subspan(run * width, width)))
          << estimator << run;
    }
  }
}

/// Runs together, as an engine hands them out.
std::vector<mc::RunWork> together(mc::RunWorker& worker, const mc::StudyTask& task,
                                  std::uint64_t first, std::vector<double>& rows) {
  const std::size_t width = task.columns().size();
  std::vector<mc::RunWork> runs;
  for (std::size_t k = 0; k * width < rows.size(); ++k)
    runs.push_back({first + k, std::span(rows).subspan(k * width, width), {}});
  worker.execute(runs);
  return runs;
}

TEST(StudyTask, ARunIsTheSameAmongOthersAndByItself) {
  // One filter can be in lanes and one cannot: its drift walks.
  for (const char* walk : {"\"0 deg/h/sqrt(h)\"", "\"0.001 deg/h/sqrt(h)\""}) {
    const mc::StudyTask task = small_task({{"monte_carlo.estimator", "iterated"},
                                           {"plan.sample", "10 min"},
                                           {"filter.wrong.drift_random_walk", walk}});
    ASSERT_GT(task.together(), 1u);
    const std::size_t width = task.columns().size();
    const auto one = task.worker(), other = task.worker();
    std::vector<double> rows(5 * width, std::numeric_limits<double>::quiet_NaN());
    const auto runs = together(*one, task, 3, rows);
    for (const mc::RunWork& w : runs) {
      EXPECT_EQ(w.outcome.status, mc::RunStatus::ok) << w.outcome.cause;
      EXPECT_GT(w.outcome.filter_s, 0.0);
      const mc::Block alone = run_block(task, *other, w.run, 1);
      EXPECT_TRUE(same_bits(alone.rows, w.row)) << w.run;
    }
  }
}

TEST(StudyTask, NamesItsColumns) {
  const mc::StudyTask task = small_task();
  const auto& names = task.columns();
  ASSERT_EQ(names.size(), task.layout().count);
  const auto& right = task.layout().filters[0];
  EXPECT_EQ(names[0].name, "truth/D_F_x");
  EXPECT_EQ(names[right.at(1, C::nis)].name, "right/1/nis");
  std::vector<std::string> of_the_fit;  // names of files that are there: they stay
  for (std::size_t k = 0; k < C::fields; ++k)
    of_the_fit.push_back(names[right.at(0, C::status) + k].name);
  EXPECT_EQ(of_the_fit, (std::vector<std::string>{"right/0/status", "right/0/nis",
                                                  "right/0/nis_dof", "right/0/lag1", "right/0/nees",
                                                  "right/0/nees_dof", "right/0/nees_all"}));
  const auto eta = static_cast<std::size_t>(std::ranges::find(right.layout.params, param("eta_x")) -
                                            right.layout.params.begin());
  EXPECT_EQ(names[right.sigma(1, eta)].name, "right/1/sigma/eta_x");
  EXPECT_EQ(names[right.estimate(0, eta)].unit.symbol.view(), "arcsec");
  EXPECT_EQ(names[right.truth[eta]].name, "truth/eta_x");
}

/// Every distributed parameter is echoed as drawn and changes the recording: none is silently
/// unused.
TEST(StudyTask, EveryDistributedParameterReachesTheRecording) {
  mc::Study study =
      read_text(small_study, {{"plan.preset", "slew12"},
                              {"truth.terms",
                               "[\"fixed_drift\", \"g_drift\", \"g2_drift\", "
                               "\"gyro_misalignment\", \"torquer_scale\", \"accelerometer\"]"}});
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  std::vector<double> row(task.columns().size());
  worker->execute(3, row);
  Simulator simulator(study.truth, study.readout);
  const TruthDraw draw =
      mc::Design(study.truth, mc::DesignKind::random, 300, 5).draw(3, task.timeline().chains);
  const Measurements before = simulator.run(task.timeline(), draw, 5, 3).measured;
  int distributed = 0;
  for (std::size_t c = 0; c < task.layout().truth.size(); ++c) {
    const std::size_t p = task.layout().truth[c];
    const auto i = static_cast<Eigen::Index>(p);
    EXPECT_EQ(row[c], draw.theta[i]) << TermLibrary::specs[p].key.view();
    EXPECT_NE(row[c], 0.0);
    TruthDraw perturbed = draw;
    perturbed.theta[i] += study.truth.priors[p].sigma();
    const Measurements after = simulator.run(task.timeline(), perturbed, 5, 3).measured;
    // The same noise in both: beyond 1e-9 g or rad, 5000 times finer than the noise, it is the
    // parameter.
    const double change = std::max((after.acc - before.acc).cwiseAbs().maxCoeff(),
                                   (after.gimbal - before.gimbal).cwiseAbs().maxCoeff());
    EXPECT_GT(change, 1e-9) << TermLibrary::specs[p].key.view();
    ++distributed;
  }
  EXPECT_EQ(distributed, 60);
}

TEST(StudyTask, EstimatesWithEveryFilterOnTheSameData) {
  // The same filter twice under two names: the same bits from the same start.
  const mc::StudyTask task = small_task({{"filter.wrong.coupling", "eq5"}});
  const auto worker = task.worker();
  const mc::Block block = run_block(task, *worker, 2, 1);
  const auto &a = task.layout().filters[0], &b = task.layout().filters[1];
  EXPECT_TRUE(same_bits(std::span(block.rows).subspan(a.at(0, C::status), a.width()),
                        std::span(block.rows).subspan(b.at(0, C::status), b.width())));
  // Another start, other estimates.
  EXPECT_NE(block.rows[a.estimate(0, 0)], block.rows[a.estimate(1, 0)]);
}

TEST(StudyTask, DrawsStartsAnewInEveryRun) {
  const mc::Study study = read_text(small_study);
  const FilterSpec& filter = study.filters[0];
  const Theta a = initial_estimate(filter, 5, 0, 1);
  EXPECT_EQ(a, initial_estimate(filter, 5, 0, 1));
  EXPECT_NE(a, initial_estimate(filter, 5, 1, 1));
  EXPECT_NE(a, initial_estimate(filter, 5, 0, 2));
  EXPECT_NE(a, initial_estimate(filter, 6, 0, 1));
  EXPECT_EQ(initial_estimate(filter, 5, 9, 0), make_layout(filter).theta);
}

TEST(StudyTask, MakesAFailedIntegrationAnOutcome) {
  // A drift of 1e300 rad/s (which no study file may ask for) is beyond any integrator.
  mc::Study study = read_text(small_study);
  study.truth.priors[param("D_F_x")] = fixed(1e300);
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  std::vector<double> row(task.columns().size(), std::nan(""));
  const mc::RunOutcome out = worker->execute(0, row);
  EXPECT_TRUE(out.status == mc::RunStatus::integrator_failed ||
              out.status == mc::RunStatus::timeout);
  EXPECT_FALSE(out.cause.empty());
  EXPECT_TRUE(std::isfinite(row[0]));  // the truth that failed is there
  EXPECT_TRUE(std::isnan(row[task.layout().filters[0].at(0, C::nis)]));
  EXPECT_GE(out.total_s, out.integration_s);
}

TEST(StudyTask, RefusesWhatCannotBeStudied) {
  EXPECT_THROW(mc::StudyTask(read_text(
                   "schema = 1\n[plan]\npreset = \"six\"\n[truth]\ncoupling = \"eq5\"\n")),
               InputError);
  EXPECT_THROW(small_task({{"truth.coupling", "compensated"}, {"truth.loop.estimate", "feedback"}}),
               InputError);
}

TEST(StudyTask, RefusesTermsWhoseSurroundingsNoRunHas) {
  for (const char* section : {"[truth]", "filter.a"})
    for (const char* term : {"inner_lever_arm", "temperature_drift"}) {
      const std::string truth = section == std::string_view("[truth]") ? term : "fixed_drift",
                        filter = section == std::string_view("[truth]") ? "fixed_drift" : term;
      const mc::Study study =
          read_text(fmt::format("schema = 1\n[site]\nlatitude = \"45.75 deg\"\n[plan]\npreset = "
                                "\"six\"\n[truth]\ncoupling = \"eq5\"\nterms = [\"{}\"]\n"
                                "[[filter]]\nname = \"a\"\ncoupling = \"eq5\"\nterms = [\"{}\"]\n",
                                truth, filter));
      try {
        mc::StudyTask task(study);
        ADD_FAILURE() << section << ' ' << term;
      } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find(fmt::format("{}: term '{}' needs", section, term)),
                  std::string::npos)
            << e.what();
      }
    }
}

/// Truth and filter alike: what the filter says of itself must hold.
///
/// 300 runs. Mean NIS and NEES lie in their chi-square bands with 95 % probability each; a fixed
/// seed makes the outcome repeatable, and the bands are widened to 3 standard deviations (0.3 %).
/// Coverage of one parameter is binomial: 0.9545 +- 3.5 sqrt(0.9545 0.0455 / 300) = +- 0.042.
TEST(MatchedPair, IsConsistent) {
  const mc::StudyTask task = small_task();
  const auto worker = task.worker();
  mc::PointStatistics statistics(task.study());
  statistics.add(run_block(task, *worker, 0, 300));
  EXPECT_EQ(statistics.failures().lost().hits, 0u);
  const mc::FilterStatistics& right = statistics.filters()[0];
  const mc::StartStatistics& s = right.starts()[0];
  for (const mc::ChiSquareSum* sum : {&s.nis, &s.nees, &s.nees_all})
    EXPECT_NEAR(sum->mean(), 1.0, 3.0 * std::sqrt(2.0 / sum->dof));
  EXPECT_NEAR(s.healthy.value(), 0.95, 3.5 * std::sqrt(0.95 * 0.05 / 300.0));
  EXPECT_EQ(s.silent.hits, 0u);
  int observable = 0;
  for (const mc::ErrorStatistics& e : right.errors()) {
    if (e.learning() > 0.5) continue;
    ++observable;
    EXPECT_NEAR(e.coverage()[1].value(), 0.9545, 0.042);
    EXPECT_NEAR(e.deception().value, 1.0, 3.5 / std::sqrt(2.0 * 300.0));
  }
  EXPECT_GE(observable, 9);
  // The drawn start is a prior sigma off where the test says nothing: twice the variance, as
  // derived in starts.hpp, so NEES over all directions is above 1 and at most 2.
  EXPECT_GT(right.starts()[1].nees_all.mean(), s.nees_all.mean());
  EXPECT_LT(right.starts()[1].nees_all.mean(), 2.1);
  // The wrong equation on the same data is inconsistent.
  EXPECT_GT(statistics.filters()[1].starts()[0].nees.mean(), 1.5);
}

TEST(Trace, IsThatOfTheRunItself) {
  const mc::Study study = read_text(
      small_study, {{"monte_carlo.estimator", "ekf"}, {"monte_carlo.design", "latin_hypercube"}});
  const mc::StudyTask task(study);
  const auto worker = task.worker();
  const mc::Block block = run_block(task, *worker, 7, 1);
  const mc::RunTrace trace = mc::trace_run(study, 7);
  ASSERT_EQ(trace.filters.size(), 3u);  // two starts and one
  for (const auto& f : trace.filters) {
    const auto& columns = task.layout().filters[f.filter];
    const auto end = f.history.estimate.cols() - 1;
    for (std::size_t k = 0; k < columns.layout.size(); ++k) {
      EXPECT_EQ(f.history.estimate(static_cast<Eigen::Index>(k), end),
                block.rows[columns.estimate(f.start, k)]);
      EXPECT_EQ(f.history.sigma(static_cast<Eigen::Index>(k), end),
                block.rows[columns.sigma(f.start, k)]);
    }
  }
  struct : mc::TraceSink {
    std::vector<std::string> names;
    std::vector<std::vector<double>> rows;
    void columns(const std::vector<mc::Column>& all) override {
      for (const mc::Column& c : all) names.push_back(c.name);
    }
    void row(std::span<const double> values) override {
      rows.emplace_back(values.begin(), values.end());
    }
  } sink;
  mc::send_trace(trace, sink);
  EXPECT_EQ(std::vector(sink.names.begin(), sink.names.begin() + 7),
            (std::vector<std::string>{"filter", "start", "time", "nis", "scalars", "D_F_x",
                                      "sigma_D_F_x"}));
  const auto& first = trace.filters.front();
  ASSERT_EQ(sink.rows.size(), 3 * task.timeline().intervals.size());
  ASSERT_EQ(TermLibrary::specs[first.layout.params[0]].key.view(), "D_F_x");
  const auto& last = sink.rows[task.timeline().intervals.size() - 1];
  EXPECT_EQ(last[1], 1.0) << "starts are counted from 1";
  EXPECT_EQ(last[5], first.history.estimate(0, first.history.estimate.cols() - 1));
  EXPECT_EQ(last[6], first.history.sigma(0, first.history.sigma.cols() - 1));
}

}  // namespace
}  // namespace drift::study_task_test
