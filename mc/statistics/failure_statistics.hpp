#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/stats/proportion.hpp"
#include "mc/task/run_task.hpp"
#include "mc/task/study_columns.hpp"

namespace drift::mc {

/// Which runs failed, and whether failing has to do with the parameters: failures that do bias
/// every mean over the runs that are left.
class FailureStatistics {
 public:
  FailureStatistics(const StudyColumns& columns, const Study& study);

  void add(RunStatus status, std::uint64_t run, std::span<const double> row);

  /// Runs that yield nothing: the simulation failed. (A diverged filter is a result.)
  const stats::Rate& lost() const { return lost_; }
  const std::map<RunStatus, std::uint64_t>& by_status() const { return by_status_; }
  const std::vector<std::uint64_t>& first_failed() const { return first_failed_; }  ///< at most 20

  /// Failures of any kind by decile of a drawn parameter, lowest first.
  struct Deciles {
    std::size_t param = 0;
    std::array<stats::Rate, 10> rate{};
    double chi2 = 0.0;  ///< of equal rates, 9 degrees of freedom
  };
  std::vector<Deciles> deciles() const;

  /// Means are not to be headlined: more than 1 % of the runs are lost.
  bool too_many() const { return lost_.value() > 0.01; }

 private:
  struct Drawn {
    std::size_t param, column;
    Prior prior;
    std::array<stats::Rate, 10> rate{};
  };
  std::vector<Drawn> drawn_;
  stats::Rate lost_;
  std::map<RunStatus, std::uint64_t> by_status_;
  std::vector<std::uint64_t> first_failed_;
};

}  // namespace drift::mc
