// The table of candidates has sizes in the unit of the parameter, whatever prior was searched with.
#include "analysis/diagnosis/candidate_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/strapdown/case_diagnose.hpp"
#include "analysis/strapdown/consumer_grade.hpp"
#include "tests/support/strapdown_recording.hpp"

namespace drift::diagnosis::candidate_table_test {
namespace {

constexpr double ppm = 2000.0;  // of the asymmetry that the nominal model lacks

/// A unit whose gyros do not see the Earth.
Diagnosis diagnosed() {
  Theta theta = Theta::Zero();
  for (const char* key : {"D_F_x", "D_F_y", "D_F_z"}) test::set(theta, key, 900.0);
  test::set(theta, "s_a_z", ppm);
  const mc::Study study =
      mc::read_study_text(test::strapdown_study("45 deg", "9.8 m/s^2"), "study.toml");
  const Recording recording =
      test::strapdown_recording({.dwells = 20, .rest = 4.0, .gyro_noise = 1e-3, .seed = 5}, theta);
  const strapdown::CaseIdentification id =
      strapdown::identify_case(study, strapdown::case_study(study, recording));
  EXPECT_FALSE(id.study.compass.sees_earth);
  return strapdown::diagnose_case(study, id);
}

TEST(CandidateTable, OfAConsumersUnitSizesAreThoseOfThePriorThatWasSearchedWith) {
  const std::size_t s_a_z = TermLibrary::index("s_a_z");
  // By the library's prior rows of this parameter were a hundredth of what they are.
  ASSERT_NEAR(strapdown::consumer_prior(s_a_z).sigma(),
              100.0 * TermLibrary::specs[s_a_z].prior_si().sigma(), 1e-12);
  const Diagnosis d = diagnosed();
  const auto row = std::ranges::find_if(
      d.candidates, [&](const search::CandidateScore& c) { return c.param == s_a_z; });
  ASSERT_NE(row, d.candidates.end());
  // Linear in s_a: what is left of it to second order is s_a times itself, 0.2 %.
  EXPECT_NEAR(row->amplitude, ppm, 5.0 * row->sigma + 2e-3 * ppm);
  EXPECT_GT(row->amplitude, 5.0 * row->sigma) << "else nothing is told by it";
  // That an effect is found with a chance of 80 %: a threshold and 0.84 of its sigmas.
  EXPECT_GT(row->smallest_detectable, row->sigma);
  EXPECT_LT(row->smallest_detectable, 10.0 * row->sigma);
  EXPECT_NEAR(row->size_sigma * strapdown::consumer_prior(s_a_z).sigma() /
                  TermLibrary::specs[s_a_z].unit.to_si,
              std::abs(row->amplitude), 2e-3 * ppm);
  // The cause that is named has the same size.
  for (const search::Cause& c : d.causes)
    for (const search::CauseParameter& p : c.parameters)
      if (p.param == s_a_z) {
        EXPECT_NEAR(p.value, row->amplitude, p.sigma + row->sigma);
      }
}

}  // namespace
}  // namespace drift::diagnosis::candidate_table_test
