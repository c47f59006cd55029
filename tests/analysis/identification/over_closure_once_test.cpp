// Lambda's posterior where several starts of a filter end at one point.
#include <gtest/gtest.h>

#include <utility>

#include "analysis/identification/identify.hpp"

namespace drift::over_closure_once_test {
namespace {

using identification::Identification;

/// Under lambda from three starts, and under eq. (6) from two.
mc::Study study() {
  return mc::read_study_text(R"(schema = 1
[site]
latitude = "45 deg"
[plan]
preset = "six"
dwell = "40 min"
sample = "4 min"
mode = "free"
[readout]
accelerometer_noise = "30 ug"
gimbal_noise = "10 arcsec"
[truth]
coupling = "lambda"
terms = ["fixed_drift", "gyro_misalignment", "frame_closure"]
[[filter]]
name = "f"
coupling = "lambda"
terms = ["fixed_drift", "gyro_misalignment", "frame_closure"]
starts = 3
[[filter]]
name = "eq6"
coupling = "eq6"
terms = ["fixed_drift", "gyro_misalignment"]
starts = 2
[monte_carlo]
runs = 1
seed = 9
)",
                             "s.toml");
}

/// What the first two starts of a filter came to, which stand at one point: to the square of the
/// tolerance of a fit.
std::pair<const BatchResult*, const BatchResult*> first_two(const Identification& id,
                                                            std::size_t filter) {
  const auto runs = id.runs_of(filter);
  const BatchResult &a = runs[0]->batch, &b = runs[1]->batch;
  EXPECT_NEAR(a.estimate.statistic, b.estimate.statistic, 1e-8);
  return {&a, &b};
}

TEST(OverClosureOnce, StartsThatEndAtOnePointHaveOneEstimate) {
  const mc::Study s = study();
  const Identification id = identification::identify_simulated(s, 0, 2);
  const auto [a, b] = first_two(id, 0);
  EXPECT_EQ(a->estimate.covariance, b->estimate.covariance);
  for (std::size_t k = 0; k < a->estimate.parameters.size(); ++k) {
    const ParameterEstimate &p = a->estimate.parameters[k], &q = b->estimate.parameters[k];
    EXPECT_EQ(p.value, q.value) << k;
    EXPECT_EQ(p.sigma, q.sigma) << k;
    EXPECT_NE(p.start, q.start) << k;
  }
  // A filter without lambda keeps what each start came to.
  const auto [c, d] = first_two(id, 1);
  EXPECT_NE(c->estimate.parameters.front().value, d->estimate.parameters.front().value);
}

}  // namespace
}  // namespace drift::over_closure_once_test
