#pragma once

#include <string>
#include <vector>

#include "core/estimate/sequential/ekf.hpp"
#include "core/sim/simulate.hpp"
#include "mc/study/study.hpp"
#include "mc/task/run_task.hpp"

namespace drift::mc {

/// How the estimates of one run went, sample by sample.
struct RunTrace {
  struct Filter {
    std::size_t filter = 0, start = 0;
    Layout layout;
    EkfHistory history;
  };
  OdeResult ode;  ///< not ok: the simulation failed, there are no filters
  Theta truth;    ///< at the end of the run, SI
  std::vector<Filter> filters;
};

/// Executes run number `run` of a study point again, with the history of every EKF (with estimator
/// "iterated" or "batch": of the EKF from the same start). A pure function of (point, run).
RunTrace trace_run(const Study& point, std::uint64_t run);

/// To a sink, one row per filter, start and sample: filters by their number, for each parameter of
/// any filter its estimate and sigma, NaN where a filter has no such parameter.
void send_trace(const RunTrace& trace, TraceSink& sink);

}  // namespace drift::mc
