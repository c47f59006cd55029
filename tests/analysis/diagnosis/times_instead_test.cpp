// Whether another clock is told in the place of what was found.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/diagnosis/doubts/site_doubt.hpp"
#include "analysis/inference/thresholds.hpp"

namespace drift::diagnosis::times_instead_test {
namespace {

/// A tenth too short, by evidence of so much chi-square.
identification::ClockDoubt clock(double chi2_above) {
  identification::ClockDoubt c{1.1, 0.02, 1.36, 1.28};
  c.weigh(chi2_above);
  return c;
}

ClockOfMisfit finds(double chi2_above) {
  return [=](double) { return std::optional(clock(chi2_above)); };
}

constexpr double evident = 60.0, not_evident = 10.0;

/// An effect that leaves as little as such times, with this log evidence under the noise that is
/// declared and under that which was found.
Diagnosis diagnosed(double as_declared, double as_found) {
  Diagnosis d;
  d.of_case = true;
  d.verdict = Verdict::ambiguous;
  d.fit.dof = 1000;
  d.fit.chi2_per_dof_before = 1.36;
  d.fit.chi2_per_dof_after = 1.28;
  d.patched.active.set(TermLibrary::index("kT_y"));
  search::Cause& cause = d.causes.emplace_back();
  cause.term = "temperature_drift";
  cause.log_bayes_as_declared = as_declared;
  cause.log_bayes = as_found;
  return d;
}

/// The log evidence of an effect that is as probable as such times.
double as_probable() {
  return clock(evident).log_evidence + std::log(inference::SiteLimits::another) -
         std::log(inference::PosteriorPrior::library);
}

TEST(TimesInstead, OfACaseAreNotToldWhereTheCausesHaveBetterOddsThanNineteenToOne) {
  ASSERT_TRUE(clock(evident).evident());
  for (const auto& [odds, told] : {std::pair{18.0, true}, {20.0, false}, {1e30, false}}) {
    Diagnosis d = diagnosed(as_probable() + std::log(odds), 0.0);
    const auto times = times_instead(finds(evident), d);
    ASSERT_EQ(times.has_value(), told) << odds;
    if (told) {
      EXPECT_NEAR(times->odds * odds, 1.0, 1e-9);
    }
    // Of a platform a survey and a clock leave one trace, and both can be looked up.
    d.of_case = false;
    std::swap(d.causes.front().log_bayes, d.causes.front().log_bayes_as_declared);
    EXPECT_TRUE(times_instead(finds(evident), d)) << odds;
  }
}

TEST(TimesInstead, AreWeighedUnderTheNoiseThatWasFound) {
  const Diagnosis d = diagnosed(1e3, as_probable());
  EXPECT_FALSE(times_instead(finds(evident), d)) << "by the noise that is declared";
  const auto times = times_instead(finds(evident), d, finds(evident));
  ASSERT_TRUE(times);
  EXPECT_NEAR(times->odds, 1.0, 1e-9);
  // What such noise explains is no clock.
  ASSERT_FALSE(clock(not_evident).evident());
  const Diagnosis weak = diagnosed(0.0, 0.0);
  EXPECT_TRUE(times_instead(finds(evident), weak));
  EXPECT_FALSE(times_instead(finds(evident), weak, finds(not_evident)));
}

}  // namespace
}  // namespace drift::diagnosis::times_instead_test
