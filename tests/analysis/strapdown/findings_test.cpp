// What is said of a strapdown unit's model without a recording: of estimates made by hand.
#include "analysis/strapdown/findings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/physics/term_library.hpp"

namespace drift::strapdown::findings_test {
namespace {

EstimateResult estimate_of(const std::vector<const char*>& keys) {
  EstimateResult e;
  const auto n = static_cast<Eigen::Index>(keys.size());
  for (const char* key : keys) {
    ParameterEstimate p;
    p.param = TermLibrary::find(key).value();
    p.sigma = 1e-9;
    p.prior_sigma = 1.0;
    e.parameters.push_back(p);
  }
  e.covariance = 1e-18 * MatX::Identity(n, n);
  return e;
}

bool says_nothing_of_temperature(const Findings& f) {
  return std::ranges::any_of(
      f.unobservable, [](const Unobservable& u) { return u.what == "temperature sensitivity"; });
}

TEST(Findings, TemperatureIsUnseenOnlyWhereNothingOfTheModelFollowsIt) {
  EXPECT_TRUE(
      says_nothing_of_temperature(findings_of(estimate_of({"D_F_x", "s_x"}), EarthRate::hidden)));
  for (const char* key : {"kT_x", "kT2_y"})
    EXPECT_FALSE(
        says_nothing_of_temperature(findings_of(estimate_of({"D_F_x", key}), EarthRate::hidden)))
        << key;
}

}  // namespace
}  // namespace drift::strapdown::findings_test
