#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mc/store/block_codec.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// A run that failed.
struct Failure {
  std::uint64_t run = 0;
  RunStatus status = RunStatus::error;
  std::string cause;
  double t = 0.0;        ///< time in the test at which it failed [s]
  double seconds = 0.0;  ///< CPU time spent on it [s]
};

/// CPU seconds that the runs of a block took. Not part of the result.
struct BlockTimes {
  double integration_s = 0.0, filter_s = 0.0, total_s = 0.0;
};

/// A complete block as it goes to and comes from the store.
struct StoredBlock {
  Block block;
  BlockTimes times;
  std::vector<Failure> failures;  ///< in order of runs
};

std::uint64_t runs_of(const std::vector<StoredBlock>& blocks);

/// What a failure says of the result (all but the time it took), for the checksum.
std::string encode(const std::vector<Failure>& failures);

/// Number, mean and sum of squared deviations of values; merged in order of blocks they give the
/// same bits however the runs were shared out.
struct Moments {
  std::uint64_t n = 0;
  double mean = 0.0, m2 = 0.0;
  void add(double value);
  void merge(const Moments& later);
};

/// Of one column of a block: runs that are ok, finite values only, in order of runs.
Moments moments(const Block& block, std::size_t column, std::size_t columns);

}  // namespace drift::mc
