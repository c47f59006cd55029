#pragma once

#include <vector>

#include "analysis/discovery/diagnosis.hpp"
#include "mc/study.hpp"

namespace drift::discovery {

/// How advice is looked for.
struct AdviseOptions {
  std::size_t most = 3;     ///< additions to the plan
  double wanted = 5.0;      ///< separation that is enough [sigma]
  std::uint64_t seed = 1;   ///< of the simulation that verifies it
};

/// Extra positions that separate what a diagnosis could not: the alternatives of an ambiguous verdict,
/// or, where the nominal coupling is eq5 or eq6 and the test is blind to lambda, the two equations.
///
/// Separation of alternatives c and d once position p is added (discovery.md 2.9): if c is true,
/// Delta = a_c' (C_cc - C_cd (C_dd + 1)^-1 C_dc) a_c, C the information on the candidates that is left
/// by the nominal parameters, in prior sigmas; the lesser of both ways. Of a pool of the 24 orientations
/// of a cube, those turned by 45 deg, two case headings, both command laws, caged or slewed there, the
/// addition is taken that makes the closest pair farthest apart, again and again until it is `wanted`.
/// Information of added positions is summed: a drift that walks from one caging to the next is taken
/// as known in each alone. Between the two equations, misalignments are taken as large as the test
/// allows (root mean square): lambda shows in proportion to them.
///
/// Verified: the extended test is simulated with the most probable alternative as truth and fitted with
/// it and with the alternative closest to it; verified_sigma is the root of the difference of their
/// costs (expected_sigma give or take 1).
///
/// Empty if there is nothing to separate. recordings: as they were diagnosed.
std::vector<Advice> advise(const Study& study, const std::vector<Recording>& recordings,
                           const Diagnosis& diagnosis, const AdviseOptions& options = {});

}  // namespace drift::discovery
