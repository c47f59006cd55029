#pragma once

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "core/base/rng.hpp"
#include "mc/task/run_task.hpp"

namespace drift::test {

/// What a synthetic run does besides drawing numbers.
struct SyntheticOptions {
  std::size_t columns = 5;
  std::uint64_t seed = 1;
  std::uint64_t fail_every = 0;    ///< runs k with k % fail_every == fail_every - 1 fail; 0: none
  std::uint64_t throw_at = ~0ull;  ///< this run throws
  double milliseconds = 0.0;       ///< spent busy in every run
  std::uint64_t stop_at = ~0ull;   ///< this run sends SIGTERM to the process
  std::size_t together = 1;        ///< runs that are executed together
  double scale = 1.0;              ///< tells points apart
};

/// A cheap task with everything the engine must cope with: results that are a pure function of
/// (seed, run), failures, exceptions, a trace.
class SyntheticTask : public mc::RunTask {
 public:
  explicit SyntheticTask(SyntheticOptions o) : o_(o) {
    for (std::size_t c = 0; c < o.columns; ++c)
      columns_.push_back({"made/" + std::to_string(c), c % 2 ? unit::arcsec : unit::one});
  }
  const std::vector<mc::Column>& columns() const override { return columns_; }
  std::unique_ptr<mc::RunWorker> worker() const override { return std::make_unique<Worker>(o_); }
  std::size_t together() const override { return o_.together; }

 private:
  class Worker : public mc::RunWorker {
   public:
    explicit Worker(const SyntheticOptions& o) : o_(o) {}
    mc::RunOutcome execute(std::uint64_t run, std::span<double> row) override {
      mc::RunOutcome outcome;
      const auto until = std::chrono::steady_clock::now() +
                         std::chrono::duration<double, std::milli>(o_.milliseconds);
      if (run == o_.stop_at) std::raise(SIGTERM);
      if (run == o_.throw_at) throw std::runtime_error("thrown by run " + std::to_string(run));
      Stream stream(o_.seed, run, Purpose::test);
      for (double& v : row) v = o_.scale * stream.normal();
      if (o_.fail_every > 0 && run % o_.fail_every == o_.fail_every - 1) {
        for (double& v : row) v = std::nan("");
        outcome.status = mc::RunStatus::filter_diverged;
        outcome.cause = "made to fail";
        outcome.t_failed = 10.0 * static_cast<double>(run);
      }
      while (std::chrono::steady_clock::now() < until) {
      }
      outcome.total_s = 1e-3 * o_.milliseconds;
      return outcome;
    }
    mc::RunOutcome trace(std::uint64_t run, std::span<double> row, mc::TraceSink& sink) override {
      sink.columns({{"time", unit::s}, {"value", unit::arcsec}});
      Stream stream(o_.seed, run, Purpose::test);
      for (int i = 0; i < 10; ++i) sink.row(std::array{60.0 * i, stream.normal()});
      return execute(run, row);
    }

   private:
    SyntheticOptions o_;
  };

  SyntheticOptions o_;
  std::vector<mc::Column> columns_;
};

/// Has enough when the mean of the first column is known to within `half_width` (one sigma).
class MeanRule : public mc::StopRule {
 public:
  MeanRule(std::size_t columns, double half_width) : columns_(columns), half_width_(half_width) {}
  bool enough(const mc::Block& block) override {
    for (std::size_t r = 0; r < block.status.size(); ++r)
      if (const double v = block.rows[r * columns_]; std::isfinite(v))
        ++n_, sum_ += v, squares_ += v * v;
    const double mean = sum_ / n_;
    return std::sqrt((squares_ / n_ - mean * mean) / n_) < half_width_;
  }

 private:
  std::size_t columns_;
  double half_width_, n_ = 0.0, sum_ = 0.0, squares_ = 0.0;
};

}  // namespace drift::test
