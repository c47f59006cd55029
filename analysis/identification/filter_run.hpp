#pragma once

#include "analysis/identification/identify.hpp"

namespace drift::identification {

/// A filter of a study and one of its starts, which begins as the study says; beyond its starts,
/// at the prior mean.
struct Job {
  std::size_t filter, start;
};

/// EKF and batch fit of what was measured.
FilterRun estimate(const mc::Study& study, const Job& job, const Timeline& timeline,
                   const Measurements& measured);

/// The same in the loop: the test is simulated position by position, and at the start of each the
/// loop is given the filter's running estimate of the misalignments.
FilterRun estimate_in_the_loop(const mc::Study& study, const Job& job, Timeline timeline,
                               const TruthDraw& draw, std::uint64_t run_number);

/// Throws InputError where a simulation failed.
void require_ok(const OdeResult& ode, std::uint64_t run);

}  // namespace drift::identification
