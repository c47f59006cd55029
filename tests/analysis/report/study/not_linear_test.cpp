// What a study says of sigmas that are too small because the model is not linear over what stays
// unknown.
#include <gtest/gtest.h>

#include "analysis/inference/thresholds.hpp"
#include "analysis/report/study/sections.hpp"
#include "tests/mc/small_study.hpp"
#include "tests/support/polar_plan.hpp"

namespace drift::not_linear_test {
namespace {

std::string at_the_pole(std::string_view noise) {
  return std::string("schema = 1\ntitle = \"pole\"\n") + test::polar_plan +
         fmt::format(R"(accelerometer_noise = "{}"
[truth]
coupling = "eq6"
terms = ["fixed_drift", "g_drift", "gyro_misalignment"]
[[filter]]
name = "f"
coupling = "eq6"
terms = ["fixed_drift", "g_drift", "gyro_misalignment"]
starts = [{{}}]
[monte_carlo]
runs = 150
seed = 984589
estimator = "batch"
)",
                     noise);
}

report::StudyResults results_of(const std::string& text, std::size_t runs) {
  report::StudyResults results;
  results.study = test::read_text(text);
  results.points = mc::study_points(results.study);
  const mc::StudyTask task(results.points[0].study);
  const auto worker = task.worker();
  results.statistics.emplace_back(task.study());
  results.statistics.back().add(test::run_block(task, *worker, 0, runs));
  return results;
}

bool said(const report::StudyResults& results) {
  const auto texts = report::study_in_brief(results).more.texts();
  return std::ranges::any_of(texts, [](const std::string& t) {
    return t.find("The sigmas are too small: errors are ") == 0 &&
           t.find("linear about one estimate") != std::string::npos;
  });
}

TEST(NotLinear, SigmasThatAreTooSmallForTheirOwnTruthsAreSaidToBe) {
  // NEES/dof 1.28 +- 0.03 where chance leaves 1 (150 runs): 8 sigma.
  report::StudyResults results = results_of(at_the_pole("5 ug"), 150);
  const mc::ChiSquareSum& nees = results.statistics[0].filters()[0].starts()[0].nees;
  EXPECT_GT(nees.sigmas_above(), inference::FitLimits::misfit);
  EXPECT_LT(report::sigmas_off(results.statistics[0].filters()[0].starts()[0]),
            report::much_too_small);
  EXPECT_TRUE(said(results));
  // Of truths that are not those the filter believes in it may be their doing.
  results.points[0].study.truth.initial_attitude *= 2.0;
  EXPECT_FALSE(said(results));
}

TEST(NotLinear, NothingIsSaidWhereNoiseHidesIt) {
  // 1.02 +- 0.03: with 100 ug the products are smaller than what is known of their factors.
  EXPECT_FALSE(said(results_of(at_the_pole("100 ug"), 150)));
}

}  // namespace
}  // namespace drift::not_linear_test
