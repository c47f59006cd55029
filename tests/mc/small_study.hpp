#pragma once

#include <cmath>
#include <span>

#include "mc/task/study_task.hpp"
#include "tests/mc/study/study_file.hpp"

namespace drift::test {

/// A study whose runs take a millisecond: few parameters, short dwells.
inline const std::string small_study = R"toml(schema = 1
title = "Small"
[site]
latitude = "45.75 deg"
[plan]
preset = "six"
dwell = "20 min"
sample = "2 min"
[truth]
coupling = "eq5"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
[[filter]]
name = "right"
coupling = "eq5"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
starts = 2
[[filter]]
name = "wrong"
coupling = "eq6"
terms = ["fixed_drift", "D_I", "gyro_misalignment", "K0"]
[monte_carlo]
runs = 300
seed = 5
estimator = "iterated"
)toml";

/// Runs first .. first + n - 1 of a task, as the engine would store them.
inline mc::Block run_block(const mc::StudyTask& task, mc::RunWorker& worker, std::uint64_t first,
                           std::size_t n) {
  const std::size_t width = task.columns().size();
  mc::Block block;
  block.first = first;
  block.rows.assign(n * width, std::nan(""));
  for (std::size_t k = 0; k < n; ++k)
    block.status.push_back(
        worker.execute(first + k, std::span(block.rows).subspan(k * width, width)).status);
  return block;
}

}  // namespace drift::test
