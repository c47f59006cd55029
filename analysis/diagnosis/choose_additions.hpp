#pragma once

#include "analysis/diagnosis/separation.hpp"
#include "analysis/planning/position_pool.hpp"

namespace drift::diagnosis {

/// Pairs that are to be told apart.
struct Told {
  const std::vector<Alternative>& alternatives;
  const std::vector<Contest>& pairs;
};

struct ChooseOptions {
  std::size_t most = 3;  ///< additions
  double wanted = 8.0;   ///< separation that is enough [sigma]
};

/// Additions of the pool that bring the pairs nearest to `wanted` (the mean of sigma / wanted, each
/// at most 1), one after another: by what each brings over the time it takes, and by what each
/// brings. Of both the one that comes nearer; where both reach it the shorter, unless twice the
/// time sets the closest pair more than twice as far apart. Indices into the pool. gains: what each
/// adds to `now`.
std::vector<std::size_t> choose_additions(const Information& now,
                                          const std::vector<planning::Addition>& pool,
                                          const std::vector<Information>& gains, const Told& told,
                                          const ChooseOptions& options);

}  // namespace drift::diagnosis
