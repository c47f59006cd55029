#pragma once

#include "mc/statistics/failure_statistics.hpp"
#include "mc/statistics/filter_statistics.hpp"

namespace drift::mc {

/// All statistics of one study point, fed with its blocks in order: one pass, memory that does not
/// grow with the runs, and the same bits for any threads and workers because the order is given.
class PointStatistics {
 public:
  explicit PointStatistics(const Study& study);

  /// Blocks of this point, by ascending run number.
  void add(const Block& block);

  std::uint64_t runs() const { return runs_; }
  const StudyColumns& columns() const { return columns_; }
  const std::vector<FilterStatistics>& filters() const { return filters_; }
  const FailureStatistics& failures() const { return failures_; }

 private:
  StudyColumns columns_;
  std::vector<FilterStatistics> filters_;
  FailureStatistics failures_;
  std::uint64_t runs_ = 0;
};

}  // namespace drift::mc
