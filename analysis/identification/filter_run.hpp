#pragma once

#include "analysis/identification/identify.hpp"

namespace drift::identification {

/// A filter of a study and one of its starts, which begins as the study says; beyond its starts,
/// at the prior mean.
struct Job {
  std::size_t filter, start;
};

/// EKF and batch fit of what was measured. Where lambda is estimated the fit is the most probable
/// point yet, which take_over_closure() turns into the estimate.
FilterRun estimate(const mc::Study& study, const Job& job, const Timeline& timeline,
                   const Measurements& measured);

/// Takes batch fits of one test, each the most probable point, over lambda's posterior
/// (over_closure()): all fits of a filter that ended at one point at once, as the first of them.
void take_over_closure(const mc::Study& study, const MeasuredTest& test,
                       std::vector<FilterRun>& runs, int threads);

/// Estimates in the loop: the test is simulated position by position, and at the start of each the
/// loop is given the filter's running estimate of the misalignments. The batch fit is over
/// lambda's posterior, as no other start has the same test.
FilterRun estimate_in_the_loop(const mc::Study& study, const Job& job, Timeline timeline,
                               const TruthDraw& draw, std::uint64_t run_number);

/// Throws InputError where a simulation failed.
void require_ok(const OdeResult& ode, std::uint64_t run);

}  // namespace drift::identification
