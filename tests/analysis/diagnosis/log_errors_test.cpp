// Errors of a log that look like physics: numbers of positions that are late, gravity of elsewhere.
#include <gtest/gtest.h>

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/identification/common_scale.hpp"
#include "analysis/identification/identify.hpp"
#include "analysis/report/diagnosis/report.hpp"
#include "analysis/report/identify/sections.hpp"
#include "tests/support/six_positions.hpp"

namespace drift::diagnosis::log_errors_test {
namespace {

/// Both commands, as a user reads them.
struct Read {
  report::InBrief identified, diagnosed;

  Read(const mc::Study& study, const Recording& recording)
      : identified(report::identification_in_brief(
            study, identification::identify_recordings(study, {recording}, 1, {}))),
        diagnosed(report::diagnosis_in_brief(diagnosis_of(study, recording))) {}

  static Diagnosis diagnosis_of(const mc::Study& study, const Recording& recording) {
    DiagnoseOptions options;
    options.starts = 1;
    options.whiteness_draws = 0;
    return diagnose(study, {recording}, options);
  }
};

bool has(const report::InBrief& brief, std::string_view head) {
  return std::ranges::any_of(brief.more.texts(),
                             [&](const std::string& text) { return text.starts_with(head); });
}

TEST(LateLabels, AreWhatToCorrectFirst) {
  const mc::Study study = test::six_study();
  Recording r = test::simulated(study);
  EXPECT_FALSE(has(Read(study, r).identified, "Labels"));
  std::vector<double>& position = test::channel(r, "position");
  std::shift_right(position.begin(), position.end(), 1);
  const Read late(study, r);
  EXPECT_TRUE(has(late.identified, "Labels: In the last row of "));
  EXPECT_NE(late.identified.next.find("correct the numbers of the positions"), std::string::npos);
  EXPECT_TRUE(has(late.diagnosed, "Labels: In the last row of "));
  EXPECT_NE(late.diagnosed.next.find("correct the numbers of the positions"), std::string::npos);
}

TEST(LateLabels, AreNoneWhereOtherSamplesStandOutTooOrFewPositionsDo) {
  using identification::Spike;
  std::vector<Spike> spikes{{0, 60.0, 1, true}, {1, 60.0, 1, true}, {0, 120.0, 2, true}};
  EXPECT_EQ(identification::late_labels(spikes), 0u);
  spikes.push_back({2, 180.0, 3, true});
  EXPECT_EQ(identification::late_labels(spikes), 3u);
  spikes.push_back({2, 150.0, 3, false});
  EXPECT_EQ(identification::late_labels(spikes), 0u);
}

TEST(CommonScale, IsTheGravityByWhichMetresBecameG) {
  mc::Study study = test::six_study();
  study.truth.active &= ~test::only({"K1"});
  Recording r = test::simulated(study);
  EXPECT_FALSE(has(Read(study, r).identified, "Gravity"));
  for (const char* key : {"acc_x", "acc_y", "acc_z"})
    for (double& f : test::channel(r, key)) f *= 9.83 / 9.80665;
  const Read read(study, r);
  for (const report::InBrief* brief : {&read.identified, &read.diagnosed})
    EXPECT_TRUE(has(*brief, "Gravity: K1_x, K1_y and K1_z are larger alike: of readings"))
        << brief->verdict;
}

/// The three K1 in prior sigmas of 500 ppm.
EstimateResult scales(const Vec3& sigmas) {
  EstimateResult out;
  for (int i = 0; i < 3; ++i) {
    ParameterEstimate p;
    p.param = TermLibrary::index("K1_x") + static_cast<std::size_t>(i);
    p.prior_sigma = 5e-4;
    p.value = sigmas[i] * p.prior_sigma;
    p.sigma = 1e-6;
    out.parameters.push_back(p);
  }
  return out;
}

TEST(CommonScale, IsOfThreeThatLieFarOffAndAlike) {
  using identification::common_scale;
  // Five sigmas of the mean of three are 2.9 of each; chi-square of two differences 13.8 at 1e-3.
  EXPECT_FALSE(common_scale(scales({2.8, 2.8, 2.8})));
  ASSERT_TRUE(common_scale(scales({3.0, 3.0, 3.0})));
  EXPECT_NEAR(common_scale(scales({-3.0, -4.0, -5.0}))->value, -2e-3, 1e-15);
  EXPECT_NEAR(common_scale(scales({3.0, 4.0, 5.0}))->sigma, 5e-4 / std::sqrt(3.0), 1e-8);
  EXPECT_TRUE(common_scale(scales({4.0, 6.6, 9.2})));   // 13.5
  EXPECT_FALSE(common_scale(scales({4.0, 6.7, 9.4})));  // 14.6
  EXPECT_FALSE(common_scale(scales({0.0, 0.0, 12.0}))) << "one accelerometer of its own";
}

}  // namespace
}  // namespace drift::diagnosis::log_errors_test
