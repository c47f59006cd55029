#pragma once

#include "core/plan/test_plan.hpp"
#include "tests/support/model_builders.hpp"

namespace drift::test {

inline const Prior of_lambda = normal(0.5, 0.29);

/// Two slews after one caging: lambda and the misalignments are seen as their product and little
/// else.
inline TestPlan few_slews() {
  TestPlan plan = preset_plan("six", {.dwell = 2400.0, .sample = 240.0}).value();
  plan.positions.resize(3);
  for (std::size_t p = 1; p < 3; ++p) plan.positions[p].entry = Entry::torqued;
  return plan;
}

template <class Spec>
Spec with_lambda(Spec spec) {
  spec.active = params_named("fixed_drift") | params_named("g_drift") |
                params_named("gyro_misalignment") | params_named("torquer_scale");
  spec.active.set(closure_param);
  spec.priors[closure_param] = of_lambda;
  return spec;
}

inline const Site in_the_south{-45.0 * detail::deg};

}  // namespace drift::test
